#include <imgui.h>

#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/properties.h"
#include "ui/scene_edit.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

const char* kind_name(ItemKind kind) {
  switch (kind) {
    case ItemKind::Object:
      return "Object";
    case ItemKind::Material:
      return "Material";
    case ItemKind::Texture:
      return "Texture";
    case ItemKind::Medium:
      return "Medium";
    case ItemKind::None:
      break;
  }
  return "";
}

void draw_header(Workbench& bench, Selection selection) {
  std::string name = item_name(bench.editor.scene, selection);
  if (text_field(kind_name(selection.kind), name)) rename(bench.editor.scene, selection, name);
  const float width = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::Button((std::string(icon::kCopy) + "  Duplicate").c_str(), {width, 0})) {
    bench.request(Action::Duplicate);
  }
  note_widget("Duplicate");
  ImGui::SameLine();
  if (ImGui::Button((std::string(icon::kRemove) + "  Delete").c_str(), {width, 0})) {
    bench.request(Action::Delete);
  }
  note_widget("Delete");
}

}  // namespace

void draw_properties_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kProperties)) {
    const Selection selection = bench.editor.selection;
    if (!is_valid(bench.editor.scene, selection)) {
      note("Nothing selected. Click an object in the picture, or an entry of a list.");
    } else {
      // Widget state (text being typed, open pickers) belongs to one item.
      ImGui::PushID(kind_name(selection.kind));
      ImGui::PushID(selection.index);
      draw_header(bench, selection);
      ImGui::Spacing();
      switch (selection.kind) {
        case ItemKind::Object:
          draw_object_properties(bench, selection.index);
          break;
        case ItemKind::Material:
          draw_material_properties(bench, selection.index);
          break;
        case ItemKind::Texture:
          draw_texture_properties(bench, selection.index);
          break;
        case ItemKind::Medium:
          draw_medium_properties(bench, selection.index);
          break;
        case ItemKind::None:
          break;
      }
      ImGui::PopID();
      ImGui::PopID();
    }
  }
  ImGui::End();
}

}  // namespace lightbench::ui
