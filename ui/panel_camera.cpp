#include <imgui.h>

#include <cmath>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void draw_lens(Camera& camera, double step) {
  number_field("Field of view", camera.vfov,
               {.speed = 0.1, .min = 0.5, .max = 175, .format = "%.4g\xc2\xb0", .tip = "Vertical"});
  double focal = focal_length(camera);
  if (number_field("Focal length", focal,
                   {.speed = 0.2, .min = 0.5, .max = 5000, .format = "%.4g mm"})) {
    camera.vfov = vfov_from_focal_length(focal, camera.sensor_height);
  }
  double sensor = camera.sensor_height;
  if (number_field("Sensor height", sensor,
                   {.speed = 0.1,
                    .min = 1,
                    .max = 1000,
                    .format = "%.4g mm",
                    .tip = "Keeps the focal length and changes the field of view"})) {
    camera.sensor_height = sensor;
    camera.vfov = vfov_from_focal_length(focal, sensor);
  }
  number_field("Aperture", camera.lens_radius,
               {.speed = 0.1 * step,
                .min = 0,
                .format = "%.4g",
                .tip = "Radius of the lens in scene units; 0 = everything is sharp"});
  double stop = f_stop(camera);
  const bool pinhole = !std::isfinite(stop);
  double shown = pinhole ? 0 : stop;
  if (number_field("f-stop", shown,
                   {.speed = 0.05,
                    .min = 0,
                    .max = 1e6,
                    .format = pinhole ? "pinhole" : "f/%.3g",
                    .tip = "The same aperture for a scene in metres; 0 = pinhole"})) {
    camera.lens_radius = shown > 0 ? lens_radius_from_f_stop(shown, focal_length(camera)) : 0;
  }
  number_field("Focus distance", camera.focus_distance,
               {.speed = step,
                .min = 1e-6,
                .format = "%.5g",
                .tip = "Along the view axis; Shift+click in the picture sets it"});
}

void draw_shutter(Camera& camera) {
  number_field("Opens", camera.shutter_open, {.speed = 0.005, .format = "%.3g"});
  number_field("Closes", camera.shutter_close, {.speed = 0.005, .format = "%.3g"});
  if (camera.shutter_close < camera.shutter_open) camera.shutter_close = camera.shutter_open;
}

}  // namespace

void draw_camera_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kCamera)) {
    Camera& camera = bench.editor.scene.camera;
    const double step = length_step(bench.editor.scene);
    if (section("Lens")) draw_lens(camera, step);
    if (section("Position")) {
      vector_field("From", camera.look_from, {.speed = step});
      vector_field("At", camera.look_at, {.speed = step});
      vector_field("Up", camera.up, {.speed = 0.01});
      ImGui::BeginDisabled(bench.editor.selection.kind != ItemKind::Object);
      if (ImGui::Button("Frame selection")) bench.request(Action::FrameSelection);
      ImGui::EndDisabled();
      note_widget("Frame selection");
      ImGui::SameLine();
      if (ImGui::Button("Frame all")) bench.request(Action::FrameAll);
      note_widget("Frame all");
    }
    if (section("Shutter")) draw_shutter(camera);
  }
  ImGui::End();
}

}  // namespace lightbench::ui
