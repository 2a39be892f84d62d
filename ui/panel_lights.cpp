#include <imgui.h>

#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/item_list.h"
#include "ui/panels.h"
#include "ui/radiance_fields.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

std::vector<int> emitting_objects(const Scene& scene) {
  std::vector<int> lights;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const int material = scene.objects[i].material;
    if (material != kNone && emits(scene.materials[static_cast<std::size_t>(material)])) {
      lights.push_back(static_cast<int>(i));
    }
  }
  return lights;
}

/// The two things one changes most often, without leaving the list.
void draw_emission(Material& material) {
  ImGui::PushID(material.name.c_str());
  ImGui::Indent();
  radiance_fields("Colour", material.emissive, material.emissive_strength);
  ImGui::Unindent();
  ImGui::Spacing();
  ImGui::PopID();
}

}  // namespace

void draw_lights_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kLights)) {
    Scene& scene = bench.editor.scene;
    const std::vector<int> lights = emitting_objects(scene);
    if (list_header("Lights", static_cast<int>(lights.size()), "Add light")) add_light(bench);
    if (ImGui::BeginChild("lights")) {
      for (const int index : lights) {
        const Object object = scene.objects[static_cast<std::size_t>(index)];
        draw_item_row(bench, {ItemKind::Object, index}, icon::kLight, nullptr, !object.visible, 0);
        if (bench.editor.selection == Selection{ItemKind::Object, index}) {
          draw_emission(scene.materials[static_cast<std::size_t>(object.material)]);
        }
      }
      if (lights.empty()) note("None. Any object with an emitting material is a light.");
    }
    ImGui::EndChild();
  }
  ImGui::End();
}

}  // namespace lightbench::ui
