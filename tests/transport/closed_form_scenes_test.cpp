// The files in scenes/closed-form show what scenes/README.md says they show.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "app/proof/closed_forms.h"
#include "core/scene/scene_io.h"
#include "tests/transport/measure.h"
#include "tests/transport/shape_patches.h"

namespace lightbench {
using namespace proof;
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

constexpr double kLambert = 0.5 / std::numbers::pi;  // albedo over pi

double tilted_disc() {
  const EmittingPatch patch = disc_patch({-1, 2, 0.5}, {1, -1, -0.3}, 0.8, {});
  return kLambert * 10 * patch_irradiance({}, {patch});
}

/// One scattering in a ball of radius 1, seen through its middle: the way in to t, then the way out
/// in any direction, whose cosine with the radius is mu.
double single_scattering() {
  const double sigma = 0.8, albedo = 0.7;
  const double scattered = integrate(0, 2, 400, [&](double t) {
    const double r = std::abs(t - 1);
    const double out = integrate(-1, 1, 400, [&](double mu) {
      return 0.5 * std::exp(-sigma * (-r * mu + std::sqrt(1 - r * r * (1 - mu * mu))));
    });
    return albedo * sigma * std::exp(-sigma * t) * out;
  });
  return std::exp(-2 * sigma) + scattered;
}

/// The mirror is 0.8 high: at the image's distance it shows what lies below 1.4.
double light_by_a_mirror() {
  const double image =
      polygon_irradiance({}, {{3.5, 1, -0.5}, {3.5, 1, 0.5}, {3.5, 1.4, 0.5}, {3.5, 1.4, -0.5}});
  const double direct = polygon_irradiance({}, {{1, 1, 1}, {1, 1, 2}, {1, 2, 2}, {1, 2, 1}});
  return kLambert * 10 * (0.9 * image + direct);
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
    Known{"triangle-light",
          kLambert * 10 * polygon_irradiance({}, {{-1, 1.5, -0.5}, {1.5, 2, 0}, {-0.5, 2.5, 1}}),
          {}},
    Known{"tilted-disc-light", tilted_disc(), {}},
    Known{"horizon-rectangle-light",
          kLambert * 10 *
              polygon_irradiance({}, {{-1, -0.5, -1}, {-1, 1, -1}, {-1, 1, 1}, {-1, -0.5, 1}}),
          {}},
    Known{"distant-light", 0.4, {}},
    Known{"inside-emitting-sphere", 1, {}},
    Known{"single-scattering", single_scattering(), {}},
    Known{"mirror-image", 9, {}},
    Known{"mirror-irradiance", light_by_a_mirror(), {}},
    Known{"glass-image", 10 * 0.96 / 1.04, {}},
    Known{"emitter-in-glass", 10 * 0.96 / 2.25, {}},
    Known{"lens-blur", disc_share_beyond(0.1), {}},
    Known{"motion-blur", 0.2, {}},
    Known{"checker-average", 0.6, {}},
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
