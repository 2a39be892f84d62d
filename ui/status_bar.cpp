#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "core/format.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

const char* state_name(SessionState state) {
  switch (state) {
    case SessionState::Idle:
      return "Idle";
    case SessionState::Compiling:
      return "Preparing";
    case SessionState::Rendering:
      return "Rendering";
    case SessionState::Paused:
      return "Paused";
    case SessionState::Finished:
      return "Finished";
    case SessionState::Failed:
      return "Failed";
  }
  return "";
}

float fraction_done(const SessionStatus& status, const RenderSettings& render) {
  double done = 0;
  if (status.target_spp > 0) {
    done = static_cast<double>(status.spp) / static_cast<double>(status.target_spp);
  }
  if (render.time_limit > 0) done = std::max(done, status.seconds / render.time_limit);
  return static_cast<float>(std::clamp(done, 0.0, 1.0));
}

void draw_progress(const SessionStatus& status, const RenderSettings& render, float height) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float width = 14 * ImGui::GetFontSize();
  const float middle = start.y + 0.5F * height;
  const float thickness = 0.22F * ImGui::GetFontSize();
  const float done = fraction_done(status, render);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled({start.x, middle - thickness}, {start.x + width, middle + thickness},
                      ImGui::GetColorU32(ImGuiCol_FrameBg), thickness);
  if (done > 0) {
    const ImVec4 color =
        status.state == SessionState::Rendering || status.state == SessionState::Finished
            ? kPalette.accent
            : kPalette.muted;
    list->AddRectFilled({start.x, middle - thickness},
                        {start.x + std::max(done * width, 2 * thickness), middle + thickness},
                        ImGui::GetColorU32(color), thickness);
  }
  ImGui::Dummy({width, height});
}

void draw_value(const std::string& label, const std::string& value, bool first = false) {
  const float em = ImGui::GetFontSize();
  ImGui::SameLine(0, (first ? 1.0F : 1.4F) * em);
  // What does not fit in whole is left out; the statistics panel has it all.
  const float needed = ImGui::CalcTextSize((label + value).c_str()).x + 0.4F * em;
  if (needed > ImGui::GetContentRegionAvail().x) return;
  if (!label.empty()) {
    ImGui::TextColored(kPalette.muted, "%s", label.c_str());
    ImGui::SameLine(0, 0.4F * em);
  }
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace

void draw_status_bar(Workbench& bench) {
  const SessionStatus& status = bench.status;
  const float height = ImGui::GetFrameHeight() + ImGui::GetStyle().FramePadding.y;
  const float text_y = 0.5F * (height - ImGui::GetFontSize());
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ImGui::GetStyle().WindowPadding.x, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  if (ImGui::BeginViewportSideBar(
          "##status", ImGui::GetMainViewport(), ImGuiDir_Down, height,
          ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::SetCursorPosY(text_y);
    draw_progress(status, bench.editor.scene.render, ImGui::GetFontSize());
    const std::string target =
        status.target_spp > 0 ? " / " + format_integer(status.target_spp) : "";
    draw_value("", format_integer(status.spp) + target + " spp", true);
    if (bench.jobs.pending() > 0 && status.state != SessionState::Rendering) {
      draw_value("", "Working on files...");
    } else if (status.state == SessionState::Failed) {
      ImGui::SameLine(0, 1.4F * ImGui::GetFontSize());
      ImGui::TextColored(kPalette.error, "%s", status.error.c_str());
    } else {
      draw_value("", state_name(status.state));
    }
    draw_value("Elapsed", format_duration(status.seconds));
    if (status.state == SessionState::Rendering && status.remaining >= 0) {
      draw_value("Left", format_duration(status.remaining));
    }
    draw_value("Paths", format_count(status.samples_per_second, "/s"));
    draw_value("Rays", format_count(status.rays_per_second, "/s"));
    draw_value("Lights", format_integer(status.scene.lights));
    draw_value("Primitives", format_integer(status.scene.primitives));
    draw_value("Memory",
               format_bytes(static_cast<std::uint64_t>(status.scene.bytes) + status.film_bytes));
    if (status.counters.non_finite > 0) {
      ImGui::SameLine(0, 1.4F * ImGui::GetFontSize());
      ImGui::TextColored(kPalette.error, "%s non-finite",
                         format_count(static_cast<double>(status.counters.non_finite)).c_str());
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace lightbench::ui
