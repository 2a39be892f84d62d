#include <imgui.h>

#include "ui/panels.h"
#include "ui/widget_map.h"

namespace lightbench::ui {

void draw_unsaved_question(Workbench& bench) {
  if (!bench.unsaved_asked) return;
  constexpr const char* kTitle = "Save changes?";
  if (!ImGui::IsPopupOpen(kTitle)) ImGui::OpenPopup(kTitle);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (!ImGui::BeginPopupModal(kTitle, nullptr, kFlags)) return;
  ImGui::Text("\"%s\" has changes that are not saved.", bench.editor.title().c_str());
  ImGui::Spacing();
  const auto answer = [&](const char* label, Action action) {
    const bool clicked = ImGui::Button(label, {7 * ImGui::GetFontSize(), 0});
    note_widget(label);
    if (!clicked) return;
    bench.unsaved_asked = false;
    if (action != Action::None) bench.request(action);
  };
  answer("Save", Action::SaveAndContinue);
  ImGui::SameLine();
  answer("Discard", Action::DiscardAndContinue);
  ImGui::SameLine();
  answer("Cancel", Action::None);
  if (ImGui::IsKeyPressed(ImGuiKey_Escape)) bench.unsaved_asked = false;
  if (!bench.unsaved_asked) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace lightbench::ui
