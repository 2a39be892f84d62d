#include <imgui.h>

#include <algorithm>
#include <cctype>

#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/item_list.h"
#include "ui/panels.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

bool is_light(const Scene& scene, const Object& object) {
  return object.material != kNone &&
         emits(scene.materials[static_cast<std::size_t>(object.material)]);
}

void draw_object(Workbench& bench, int index, float eye_width) {
  Scene& scene = bench.editor.scene;
  Object& object = scene.objects[static_cast<std::size_t>(index)];
  const char* symbol = icon::kObject;
  if (is_light(scene, object))
    symbol = icon::kLight;
  else if (object.medium != kNone)
    symbol = icon::kMedium;
  draw_item_row(bench, {ItemKind::Object, index}, symbol, nullptr, !object.visible, eye_width);
  ImGui::SameLine(0, 0);
  ImGui::PushID(index);
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0, 0, 0, 0));
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, ImGui::GetStyle().FramePadding.y));
  const std::string eye = std::string(object.visible ? icon::kEye : icon::kEyeOff) + "###eye";
  if (ImGui::Button(eye.c_str(), {eye_width, 0})) object.visible = !object.visible;
  note_widget(("Hide " + object.name).c_str());
  tip_for_last(object.visible ? "Hide" : "Show");
  ImGui::PopStyleVar();
  ImGui::PopStyleColor(2);
  ImGui::PopID();
}

}  // namespace

void draw_scene_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kScene)) {
    const int count = static_cast<int>(bench.editor.scene.objects.size());
    if (list_header("Objects", count, "Add object")) ImGui::OpenPopup("add object");
    if (ImGui::BeginPopup("add object")) {
      add_object_menu(bench);
      ImGui::EndPopup();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
    if (ImGui::BeginChild("objects")) {
      const float eye_width = 1.6F * ImGui::GetFontSize();
      ImGuiListClipper clipper;
      clipper.Begin(static_cast<int>(bench.editor.scene.objects.size()));
      while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
          draw_object(bench, i, eye_width);
        }
      }
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
  }
  ImGui::End();
}

}  // namespace lightbench::ui
