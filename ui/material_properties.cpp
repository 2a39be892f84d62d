#include <imgui.h>

#include "ui/fields.h"
#include "ui/properties.h"
#include "ui/radiance_fields.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

void draw_surface(Material& material, const std::vector<std::string>& textures) {
  const bool metal = material.kind == MaterialKind::Metal;
  const bool glass = material.kind == MaterialKind::Dielectric;
  color_field("Colour", material.base_color,
              glass ? "What passes through" : (metal ? "Reflectance" : "Albedo"));
  reference_field("Texture", material.base_color_texture, textures, "none");
  if (metal) {
    // The two describe different lobes; the one that is set rules out the other.
    if (slider_field(
            "Roughness", material.roughness,
            {.min = 0, .max = 1, .format = "%.3f", .tip = "GGX, alpha = roughness squared"}) &&
        material.roughness > 0) {
      material.fuzz = 0;
    }
    if (slider_field("Fuzz", material.fuzz,
                     {.min = 0,
                      .max = 1,
                      .format = "%.3f",
                      .tip = "The books' fuzz; exclusive with roughness"}) &&
        material.fuzz > 0) {
      material.roughness = 0;
    }
  }
  if (glass) {
    number_field("Index", material.ior,
                 {.speed = 0.002,
                  .min = 0.1,
                  .max = 10,
                  .format = "%.4g",
                  .tip = "Index of refraction, inside over outside"});
  }
}

void draw_emission(Material& material, const std::vector<std::string>& textures) {
  radiance_fields("Light", material.emissive, material.emissive_strength);
  ImGui::PushID("emission");
  reference_field("Light texture", material.emissive_texture, textures, "none");
  ImGui::PopID();
  toggle_field("Two-sided", material.two_sided, "Emits from the back too");
}

}  // namespace

void draw_material_properties(Workbench& bench, int index) {
  Scene& scene = bench.editor.scene;
  Material& material = scene.materials[static_cast<std::size_t>(index)];
  const std::vector<std::string> textures = names_of(scene.textures);
  const int users = use_count(scene, {ItemKind::Material, index});
  enum_field("Type", material.kind, {"Matte", "Metal", "Glass", "Light only"});
  value_row("Used by", std::to_string(users) + (users == 1 ? " object" : " objects"));
  if (material.kind != MaterialKind::Emissive && section("Surface")) {
    draw_surface(material, textures);
  }
  if (section("Emission")) draw_emission(material, textures);
}

void draw_medium_properties(Workbench& bench, int index) {
  Medium& medium = bench.editor.scene.media[static_cast<std::size_t>(index)];
  const int users = use_count(bench.editor.scene, {ItemKind::Medium, index});
  number_field("Density", medium.density,
               {.speed = 0.02 * medium.density,
                .min = 1e-9,
                .max = 1e9,
                .format = "%.4g / unit",
                .tip = "Extinction: light is thinned to 37 % over 1 / density"});
  color_field("Albedo", medium.albedo, "Share of the light that is scattered, not absorbed");
  value_row("Used by", std::to_string(users) + (users == 1 ? " object" : " objects"));
}

}  // namespace lightbench::ui
