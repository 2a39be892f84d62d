#include <imgui.h>

#include "ui/fields.h"
#include "ui/properties.h"
#include "ui/scene_edit.h"
#include "ui/texture_files.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void draw_image_fields(Workbench& bench, Texture& texture) {
  value_row("File", texture.file.empty() ? "none" : texture.file);
  if (texture.image) {
    value_row("Size", std::to_string(texture.image->width) + " x " +
                          std::to_string(texture.image->height) + " px");
  }
  if (ImGui::Button("Choose image...", {-FLT_MIN, 0})) {
    ask_for_texture_image(bench, texture.name);
  }
  note_widget("Choose image...");
  enum_field("Wrap", texture.wrap, {"Repeat", "Clamp", "Mirror"});
  bool srgb = texture.srgb;
  if (toggle_field("sRGB", srgb, "8-bit values are sRGB encoded; off for data") &&
      !texture.file.empty()) {
    load_texture_image(bench, texture.name, texture.file, srgb);
  }
}

}  // namespace

void draw_texture_properties(Workbench& bench, int index) {
  Texture& texture = bench.editor.scene.textures[static_cast<std::size_t>(index)];
  TextureKind kind = texture.kind;
  if (enum_field("Type", kind, {"Colour", "Image", "Checker", "Noise", "Turbulence", "Marble"})) {
    // An image texture needs its picture first; the kind changes when that has arrived.
    if (kind == TextureKind::Image && !texture.image) {
      ask_for_texture_image(bench, texture.name);
    } else {
      texture.kind = kind;
    }
  }
  const NumberStyle scale{.speed = 0.01 * texture.scale, .min = 1e-9, .max = 1e9, .format = "%.4g"};
  switch (texture.kind) {
    case TextureKind::Constant:
      color_field("Colour", texture.color_a);
      break;
    case TextureKind::Image:
      draw_image_fields(bench, texture);
      break;
    case TextureKind::Checker:
      color_field("Even", texture.color_a);
      color_field("Odd", texture.color_b);
      number_field("Cells", texture.scale, scale);
      toggle_field("In uv", texture.use_uv, "On the surface's uv instead of in space");
      break;
    case TextureKind::Noise:
    case TextureKind::Turbulence:
    case TextureKind::Marble:
      color_field("Low", texture.color_a);
      color_field("High", texture.color_b);
      number_field("Frequency", texture.scale, scale);
      if (texture.kind != TextureKind::Noise) {
        integer_field("Octaves", texture.octaves, 1, 16);
      }
      seed_field("Seed", texture.seed);
      break;
  }
  const int users = use_count(bench.editor.scene, {ItemKind::Texture, index});
  value_row("Used by", std::to_string(users) + (users == 1 ? " material" : " materials"));
}

}  // namespace lightbench::ui
