// The files in scenes/closed-form show what scenes/README.md says they show.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/scene/scene_io.h"
#include "tests/transport/measure.h"

namespace lightbench {
namespace {

struct Known {
  const char* scene;
  double radiance;
  Crop window;  ///< where the picture shows it; everywhere if empty
};

/// A 3 x 1 light at height 2 over the middle: four rectangles that share a corner there.
double over_the_middle_of_a_rectangle() {
  const double a = 1.5, b = 0.5, height = 2, emitted = 10, albedo = 0.5;
  const double far_a = std::hypot(a, height), far_b = std::hypot(b, height);
  const double corner =
      emitted / 2 * (a / far_a * std::atan(b / far_a) + b / far_b * std::atan(a / far_b));
  return albedo / std::numbers::pi * 4 * corner;
}

const std::array kKnown{
    Known{"furnace", 0.5, {26, 26, 12, 12}},
    Known{"furnace", 1, {0, 0, 8, 8}},
    Known{"furnace-lossless", 1, {}},
    Known{"sphere-light-over-plane", 1.25, {}},
    Known{"disc-light", 1, {}},
    Known{"rectangle-light", over_the_middle_of_a_rectangle(), {}},
    Known{"emissive-room", 2, {}},
    Known{"absorbing-slab", std::exp(-1.0), {}},
    Known{"fog-furnace", 1, {}},
};

class ClosedFormScenes : public testing::TestWithParam<KernelUnderTest> {};

TEST_P(ClosedFormScenes, ShowTheStatedRadiance) {
  const KernelUnderTest kernel = GetParam();
  Family family = kernel.family();
  for (const Known& known : kKnown) {
    Scene scene = load_scene(std::string(LIGHTBENCH_SOURCE_DIR "/scenes/closed-form/") +
                             known.scene + ".json");
    scene.render.crop = known.window;
    const int spp = kernel.spp(4 * scene.render.spp);
    family.add(known.scene, known.radiance, measure_uniform(scene, kernel.kind, spp));
  }
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, ClosedFormScenes, testing::Values(kFastKernel, kReferenceKernel));

}  // namespace
}  // namespace lightbench
