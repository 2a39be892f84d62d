#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

constexpr int kMaxSize = 16384;

void draw_progress_buttons(Workbench& bench) {
  const bool paused = bench.status.state == SessionState::Paused;
  const float width = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  const std::string pause =
      paused ? std::string(icon::kPlay) + "  Resume" : std::string(icon::kPause) + "  Pause";
  if (ImGui::Button((pause + "###pause").c_str(), {width, 0})) bench.request(Action::PauseResume);
  note_widget("Pause");
  ImGui::SameLine();
  if (ImGui::Button((std::string(icon::kRestart) + "  Restart###restart").c_str(), {width, 0})) {
    bench.request(Action::Restart);
  }
  note_widget("Restart");
}

void draw_size(RenderSettings& render) {
  integer_field("Width", render.width, 1, kMaxSize, "%d px");
  integer_field("Height", render.height, 1, kMaxSize, "%d px");
  bool cropped = render.crop.width > 0;
  if (toggle_field("Crop", cropped, "Render only a window of the picture")) {
    render.crop = cropped ? Crop{render.width / 4, render.height / 4, std::max(1, render.width / 2),
                                 std::max(1, render.height / 2)}
                          : Crop{};
  }
  if (render.crop.width == 0) return;
  Crop& crop = render.crop;
  integer_field("Left", crop.x, 0, render.width - 1, "%d px");
  integer_field("Top", crop.y, 0, render.height - 1, "%d px");
  integer_field("Crop width", crop.width, 1, render.width, "%d px");
  integer_field("Crop height", crop.height, 1, render.height, "%d px");
  // The window stays inside a picture that was made smaller.
  crop.x = std::clamp(crop.x, 0, render.width - 1);
  crop.y = std::clamp(crop.y, 0, render.height - 1);
  crop.width = std::clamp(crop.width, 1, render.width - crop.x);
  crop.height = std::clamp(crop.height, 1, render.height - crop.y);
}

}  // namespace

void draw_render_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kRender)) {
    RenderSettings& render = bench.editor.scene.render;
    draw_progress_buttons(bench);
    if (section("Until")) {
      integer_field("Samples", render.spp, 0, 100'000'000, render.spp == 0 ? "no limit" : "%d spp",
                    "Samples per pixel; 0 = no limit");
      number_field("Time limit", render.time_limit,
                   {.speed = 1,
                    .min = 0,
                    .max = 1e7,
                    .format = render.time_limit == 0 ? "no limit" : "%.4g s"});
    }
    if (section("Picture")) draw_size(render);
    if (section("Paths")) {
      integer_field("Depth", render.max_depth, 1, 10'000, "%d segments",
                    "Longest path from the camera");
      integer_field("Roulette after", render.roulette_depth, 0, 10'000, "%d bounces",
                    "Dim paths may end early from here on; the picture stays unbiased");
      enum_field("Strategy", render.strategy, {"Lights and BSDF", "Lights only", "BSDF only"},
                 "How light is looked for. One strategy alone shows the same picture with more "
                 "noise: for finding faults");
      enum_field("Light choice", render.light_choice, {"With images", "Contribution", "Power"},
                 "Which light a point samples: by what it would bring, images in plane mirrors "
                 "and glass included; without those; or by power");
      enum_field("Sampler", render.sampler, {"Sobol", "Independent"},
                 "Random numbers: Owen-scrambled Sobol points, or plain ones to compare with");
      toggle_field(
          "Adaptive", render.adaptive,
          "More samples where the picture is noisy, from 16 per pixel on; the counts shown "
          "are averages");
      seed_field("Seed", render.seed);
    }
    if (section("Pixel filter")) {
      enum_field("Filter", render.filter, {"Box", "Triangle", "Gaussian"});
      number_field("Radius", render.filter_radius,
                   {.speed = 0.01, .min = 0.1, .max = 8, .format = "%.3g px"});
    }
    if (section("Processor")) {
      integer_field("Threads", bench.threads, -64, 256,
                    bench.threads > 0 ? "%d" : (bench.threads == 0 ? "all" : "all but %d"),
                    "0 = all; negative = all but that many. Starts the render again");
      value_row("In use", std::to_string(bench.status.threads));
    }
  }
  ImGui::End();
}

}  // namespace lightbench::ui
