#include <imgui.h>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/radiance_fields.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void load_environment(Workbench& bench, const std::string& file) {
  load_image_later(bench, file, true, [file](Scene& scene, std::shared_ptr<const Texels> image) {
    scene.environment.kind = EnvironmentKind::Image;
    scene.environment.file = file;
    scene.environment.image = std::move(image);
  });
}

void choose_image(Workbench& bench) {
  FileQuestion question;
  question.title = "Open environment";
  question.start = bench.editor.directory();
  question.extensions = {".hdr", ".exr", ".pfm", ".png", ".jpg", ".jpeg"};
  question.chosen = [&bench](const std::filesystem::path& file) {
    load_environment(bench, asset_name(bench.editor, file));
  };
  bench.file_dialog.ask(std::move(question));
}

}  // namespace

void draw_environment_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kEnvironment)) {
    Environment& environment = bench.editor.scene.environment;
    EnvironmentKind kind = environment.kind;
    if (enum_field("Type", kind, {"Constant", "Gradient", "Image"})) {
      // An image environment needs its picture first; the kind changes when that has arrived.
      if (kind != EnvironmentKind::Image || environment.image) {
        environment.kind = kind;
      } else {
        choose_image(bench);
      }
    }
    switch (environment.kind) {
      case EnvironmentKind::Constant:
        radiance_fields("Colour", environment.color, environment.strength);
        break;
      case EnvironmentKind::Gradient:
        color_field("Zenith", environment.color, "Straight up");
        color_field("Nadir", environment.horizon, "Straight down");
        break;
      case EnvironmentKind::Image:
        color_field("Tint", environment.color, "Multiplies the image");
        number_field("Rotation", environment.rotation, {.speed = 0.5, .format = "%.4g\xc2\xb0"});
        value_row("File", environment.file);
        if (ImGui::Button("Choose image...")) choose_image(bench);
        note_widget("Choose image...");
        break;
    }
    if (environment.kind != EnvironmentKind::Constant) {
      number_field("Strength", environment.strength,
                   {.speed = 0.01, .min = 0, .max = 1e6, .format = "%.4g"});
    }
    if (environment.kind == EnvironmentKind::Constant && environment.color == glm::dvec3(0)) {
      note("Black: only the lights of the scene shine.");
    }
  }
  ImGui::End();
}

}  // namespace lightbench::ui
