#include "ui/toolbar.h"

#include <imgui.h>

#include <cstdio>

#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void draw_render_buttons(Workbench& bench) {
  const bool paused = bench.status.state == SessionState::Paused;
  if (icon_button(paused ? icon::kPlay : icon::kPause, paused ? "Resume" : "Pause")) {
    bench.request(Action::PauseResume);
  }
  ImGui::SameLine();
  if (icon_button(icon::kRestart, "Restart")) bench.request(Action::Restart);
  ImGui::SameLine();
  if (icon_button(icon::kCamera, "Snapshot now", bench.frame != nullptr)) {
    bench.request(Action::SnapshotNow);
  }
}

void draw_display(Display& display) {
  const float em = ImGui::GetFontSize();
  const double min = -20;
  const double max = 20;
  ImGui::SetNextItemWidth(5.5F * em);
  ImGui::DragScalar("##exposure", ImGuiDataType_Double, &display.exposure, 0.02F, &min, &max,
                    "%+.2f EV", ImGuiSliderFlags_AlwaysClamp);
  note_widget("Exposure");
  tip_for_last("Exposure in stops: ] and [; \\ for 0");
  ImGui::SameLine();
  int tone_map = static_cast<int>(display.tone_map);
  ImGui::SetNextItemWidth(6.5F * em);
  if (ImGui::Combo("##tone map", &tone_map, "sRGB\0Reinhard\0ACES\0")) {
    display.tone_map = static_cast<ToneMap>(tone_map);
  }
  note_widget("Tone map");
  tip_for_last("How radiance becomes screen values");
}

void draw_zoom(Workbench& bench) {
  char zoom[32];
  std::snprintf(zoom, sizeof zoom, "%.0f %%", 100 * bench.shown_zoom);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float buttons = ImGui::CalcTextSize("Fit").x + ImGui::CalcTextSize("1:1").x +
                        4 * style.FramePadding.x + 2 * style.ItemSpacing.x;
  const float text = ImGui::CalcTextSize("6400 %").x;
  const float right = ImGui::GetWindowWidth() - style.FramePadding.x;
  ImGui::SameLine();
  if (ImGui::GetCursorPosX() > right - buttons - text) {
    ImGui::NewLine();  // no room: the keys and the menu do the same
    return;
  }
  ImGui::SetCursorPosX(right - buttons - text);
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(kPalette.muted, "%s", zoom);
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - buttons + style.ItemSpacing.x);
  if (ImGui::Button("Fit")) bench.request(Action::ZoomFit);
  note_widget("Fit");
  tip_for_last("Fit the picture: Ctrl+0");
  ImGui::SameLine();
  if (ImGui::Button("1:1")) bench.request(Action::ZoomActual);
  note_widget("1:1");
  tip_for_last("One pixel per pixel: Ctrl+1; Ctrl+wheel zooms");
}

}  // namespace

void draw_toolbar(Workbench& bench) {
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  const ImVec2 start = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight() + 2 * padding.y;
  ImGui::GetWindowDrawList()->AddRectFilled(start,
                                            {start.x + ImGui::GetWindowWidth(), start.y + height},
                                            ImGui::GetColorU32(ImGuiCol_WindowBg));
  ImGui::SetCursorScreenPos({start.x + padding.x, start.y + padding.y});
  ImGui::BeginGroup();
  draw_render_buttons(bench);
  ImGui::SameLine(0, 2 * ImGui::GetStyle().ItemSpacing.x);
  draw_display(bench.editor.scene.display);
  draw_zoom(bench);
  ImGui::EndGroup();
  ImGui::SetCursorScreenPos({start.x, start.y + height});
}

}  // namespace lightbench::ui
