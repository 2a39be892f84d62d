#include <imgui.h>

#include <string>

#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void draw_group(const char* group) {
  ImGui::TextColored(kPalette.accent, "%s", group);
  if (ImGui::BeginTable(group, 2)) {
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 7.6F * ImGui::GetFontSize());
    ImGui::TableSetupColumn("action", ImGuiTableColumnFlags_WidthStretch);
    for (const Shortcut& shortcut : shortcuts()) {
      if (shortcut.group != std::string(group)) continue;
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(kPalette.muted, "%s", shortcut.keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(shortcut.label);
    }
    ImGui::EndTable();
  }
  ImGui::Spacing();
}

}  // namespace

void draw_help(Workbench& bench) {
  if (!bench.help_shown) return;
  ImGui::SetNextWindowSizeConstraints({0, 0}, ImGui::GetMainViewport()->WorkSize);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  if (ImGui::Begin("Keys", &bench.help_shown,
                   ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize)) {
    if (ImGui::BeginTable("columns", 2, ImGuiTableFlags_SizingFixedFit)) {
      // As wide as their longest lines.
      const float em = ImGui::GetFontSize();
      ImGui::TableSetupColumn("left", ImGuiTableColumnFlags_WidthFixed, 16 * em);
      ImGui::TableSetupColumn("right", ImGuiTableColumnFlags_WidthFixed, 19 * em);
      ImGui::TableNextColumn();
      for (const char* group : {"File", "Edit", "Render", "Window"}) draw_group(group);
      ImGui::TableNextColumn();
      for (const char* group : {"Picture", "Camera"}) draw_group(group);
      ImGui::EndTable();
    }
    if (ImGui::IsWindowFocused() && ImGui::IsKeyPressed(ImGuiKey_Escape)) bench.help_shown = false;
  }
  ImGui::End();
}

}  // namespace lightbench::ui
