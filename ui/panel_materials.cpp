#include <imgui.h>

#include "core/film/tone_map.h"
#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/item_list.h"
#include "ui/panels.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

ImVec4 screen_color(const glm::dvec3& linear) {
  const auto value = display_value(
      {static_cast<float>(linear.x), static_cast<float>(linear.y), static_cast<float>(linear.z)},
      Display{});
  return {value[0], value[1], value[2], 1};
}

ImVec4 swatch_of(const Material& material) {
  return screen_color(material.kind == MaterialKind::Emissive ? material.emissive
                                                              : material.base_color);
}

}  // namespace

void draw_materials_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kMaterials)) {
    const Scene& scene = bench.editor.scene;
    if (list_header("Materials", item_count(scene, ItemKind::Material), "Add material")) {
      ImGui::OpenPopup("add material");
    }
    if (ImGui::BeginPopup("add material")) {
      add_material_menu(bench);
      ImGui::EndPopup();
    }
    for (int i = 0; i < item_count(scene, ItemKind::Material); ++i) {
      const ImVec4 swatch = swatch_of(scene.materials[static_cast<std::size_t>(i)]);
      draw_item_row(bench, {ItemKind::Material, i}, icon::kMaterial, &swatch, false, 0);
    }
    ImGui::Spacing();
    ImGui::Spacing();
    ImGui::PushID("textures");
    if (list_header("Textures", item_count(scene, ItemKind::Texture), "Add texture")) {
      ImGui::OpenPopup("add texture");
    }
    if (ImGui::BeginPopup("add texture")) {
      add_texture_menu(bench);
      ImGui::EndPopup();
    }
    for (int i = 0; i < item_count(scene, ItemKind::Texture); ++i) {
      draw_item_row(bench, {ItemKind::Texture, i}, icon::kTexture, nullptr, false, 0);
    }
    ImGui::PopID();
    ImGui::Spacing();
    ImGui::Spacing();
    ImGui::PushID("media");
    if (list_header("Media", item_count(scene, ItemKind::Medium), "Add medium")) add_medium(bench);
    for (int i = 0; i < item_count(scene, ItemKind::Medium); ++i) {
      draw_item_row(bench, {ItemKind::Medium, i}, icon::kMedium, nullptr, false, 0);
    }
    ImGui::PopID();
  }
  ImGui::End();
}

}  // namespace lightbench::ui
