#include <imgui.h>

#include "ui/item_list.h"
#include "ui/panels.h"
#include "ui/scene_edit.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void item(Workbench& bench, const char* label, Action action, bool enabled = true) {
  if (ImGui::MenuItem(label, shortcut_keys(action), false, enabled)) bench.request(action);
  note_widget(label);
}

void toggle(const char* label, Action action, bool& shown) {
  ImGui::MenuItem(label, shortcut_keys(action), &shown);
  note_widget(label);
}

/// `draw` fills the menu when it is open.
template <class Draw>
void menu(const char* label, Draw&& draw) {
  const bool open = ImGui::BeginMenu(label);
  note_widget(label);
  if (!open) return;
  draw();
  ImGui::EndMenu();
}

void add_menu(Workbench& bench) {
  menu("Object", [&] { add_object_menu(bench); });
  if (ImGui::MenuItem("Light")) add_light(bench);
  note_widget("Light");
  menu("Material", [&] { add_material_menu(bench); });
  menu("Texture", [&] { add_texture_menu(bench); });
  if (ImGui::MenuItem("Medium")) add_medium(bench);
  note_widget("Medium");
}

void draw_title(const Workbench& bench) {
  const Editor& editor = bench.editor;
  const std::string title = editor.title() + (editor.dirty() ? " *" : "");
  const float width = ImGui::CalcTextSize(title.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
  ImGui::SameLine(ImGui::GetWindowWidth() - width - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextColored(kPalette.muted, "%s", title.c_str());
  note_widget("Title");
  if (!editor.file().empty()) ImGui::SetItemTooltip("%s", editor.file().string().c_str());
}

}  // namespace

void draw_menu_bar(Workbench& bench) {
  if (!ImGui::BeginMainMenuBar()) return;
  const Editor& editor = bench.editor;
  const bool selected = is_valid(editor.scene, editor.selection);
  menu("File", [&] {
    item(bench, "New", Action::NewScene);
    item(bench, "Open...", Action::Open);
    item(bench, "Save", Action::Save);
    item(bench, "Save as...", Action::SaveAs);
    ImGui::Separator();
    item(bench, "Quit", Action::Quit);
  });
  menu("Edit", [&] {
    item(bench, "Undo", Action::Undo, editor.can_undo());
    item(bench, "Redo", Action::Redo, editor.can_redo());
    ImGui::Separator();
    item(bench, "Duplicate", Action::Duplicate, selected);
    item(bench, "Delete", Action::Delete, selected);
  });
  menu("Add", [&] { add_menu(bench); });
  menu("Render", [&] {
    item(bench, bench.status.state == SessionState::Paused ? "Resume" : "Pause",
         Action::PauseResume);
    item(bench, "Restart", Action::Restart);
    item(bench, "Snapshot now", Action::SnapshotNow, bench.frame != nullptr);
  });
  menu("View", [&] {
    item(bench, "Frame selection", Action::FrameSelection, selected);
    item(bench, "Frame all", Action::FrameAll);
    ImGui::Separator();
    item(bench, "Fit the picture", Action::ZoomFit);
    item(bench, "One pixel per pixel", Action::ZoomActual);
    toggle("Outline selection", Action::None, bench.outline_shown);
    ImGui::Separator();
    item(bench, "Picture only", Action::TogglePanels);
    item(bench, "Full screen", Action::ToggleFullScreen);
    item(bench, "Reset layout", Action::ResetLayout);
  });
  menu("Help", [&] { toggle("Keys", Action::ToggleHelp, bench.help_shown); });
  draw_title(bench);
  ImGui::EndMainMenuBar();
}

}  // namespace lightbench::ui
