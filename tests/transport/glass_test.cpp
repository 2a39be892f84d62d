// Smooth glass. Radiance is carried per unit of projected solid angle, so it grows by the square of
// the index on the way in and shrinks by it on the way out: inside glass of index n, an environment
// of radiance L is seen as n^2 L, and an emitter inside of radiance L is seen from outside as
// T L / n^2.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

class Glass : public testing::TestWithParam<KernelUnderTest> {
 protected:
  Glass() : family(GetParam().family()) {}
  void check(const std::string& name, double expected, const Scene& scene, int spp = 512) {
    family.add(name, expected, measure_uniform(scene, GetParam().kind, GetParam().spp(spp)));
  }
  Family family;
};

TEST_P(Glass, SlabTransmitsTheWholeSeries) {
  for (const double degrees : {0.0, 30.0, 56.31, 75.0, 85.0}) {
    const double angle = degrees * kPi / 180, f = fresnel(std::cos(angle), 1.5);
    Scene s = wall_scene(400);
    add(s, BoxShape{{-100, -100, -0.5}, {100, 100, 0.5}}, glass(1.5));
    aim(s, dvec3(2 * std::tan(angle), 0, 2), dvec3(0));
    // T (1 + F^2 + F^4 + ...), T = (1 - F)^2.
    check("slab at " + std::to_string(degrees), (1 - f) / (1 + f), s, degrees > 80 ? 2048 : 512);
  }
  family.expect_agreement();
}

TEST_P(Glass, OfIndexOneIsInvisible) {
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    Scene s = wall_scene(400);
    s.meshes = shapes.meshes;
    s.render.roulette_depth = s.render.max_depth;
    add(s, placed.shape, glass(1), placed.transform);
    look(s, {0, 0, 5}, dvec3(0), 30);
    const Estimate e = measure_uniform(s, GetParam().kind, 8);
    EXPECT_NEAR(e.mean.y, 1, 1e-6) << placed.name;
    EXPECT_NEAR(e.error.y, 0, 1e-7) << placed.name;
  }
}

TEST_P(Glass, InsideItTheWorldIsBrighterByTheSquareOfTheIndex) {
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    Scene s = furnace_scene();
    s.meshes = shapes.meshes;
    add(s, placed.shape, glass(1.5), placed.transform);
    // Straight out, where no shape reflects totally for ever.
    aim(s, {0, 0, 0}, {0.2, 1, 0.1});
    check(std::string("within a ") + placed.name, 2.25, s);
  }
  family.expect_agreement();
}

TEST_P(Glass, ReflectsTotallyBeyondTheCriticalAngle) {
  // From within a block of glass through a horizontal face at 45 degrees: nothing passes, and the
  // wall seen by reflection alone has its whole radiance.
  Scene s = dark_scene();
  add(s, BoxShape{{-10, -10, -10}, {10, 0, 10}}, glass(1.5));
  add(s, RectangleShape{{-9, -9, 6}, {0, 8, 0}, {18, 0, 0}}, light(dvec3(1), true));
  aim(s, {0, -4, -4}, {0, 0, 0});
  s.render.max_depth = 2;
  const Estimate e = measure_uniform(s, GetParam().kind, 8);
  EXPECT_NEAR(e.mean.y, 1, 1e-6);
  EXPECT_NEAR(e.error.y, 0, 1e-7);
}

TEST_P(Glass, AnEmitterInsideIsSeenThroughItsBorder) {
  for (const double ior : {1.33, 1.5, 2.4}) {
    Scene s = dark_scene();
    add(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(ior));
    add(s, SphereShape{{0, 0, 0}, 0.2, {0, 0, 0}}, light(dvec3(1)));
    aim(s, {0, 0, 5}, dvec3(0));
    check("index " + std::to_string(ior), (1 - fresnel(1, ior)) / (ior * ior), s);
  }
  family.expect_agreement();
}

// Energy: of an emitter's power pi L 4 pi r^2, the share 1 - F of each ray leaves the ball around
// it and the rest returns to the (black) emitter, since a reflected ray keeps its distance from the
// centre. A camera far away must collect what passes through it: power / (4 pi D^2).
TEST_P(Glass, EnergyThatLeavesTheEmitterArrivesAtTheCamera) {
  const double r = 0.2, ior = 1.5, distance = 200;
  const double share = integrate(0, r, 1000, [&](double b) {
    return 2 * b / (r * r) * (1 - fresnel(std::sqrt(1 - b * b), 1 / ior));
  });
  Scene s = dark_scene(16);
  add(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(ior));
  add(s, SphereShape{{0, 0, 0}, r, {0, 0, 0}}, light(dvec3(1)));
  const double half = 0.5 / distance;  // shows 1 x 1 units, the emitter appears 0.6 wide
  look(s, {0, 0, distance}, dvec3(0), 2 * std::atan(half) * 180 / kPi);
  const Estimate e = measure_by_seeds(s, GetParam().kind, GetParam().spp(256), 32);
  // Irradiance = mean radiance times the picture's solid angle (2 half)^2.
  Estimate power = e;
  const double scale = 4 * half * half * 4 * kPi * distance * distance;
  power.mean *= scale;
  power.error *= scale;
  family.add("power", share * kPi * 4 * kPi * r * r, power);
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, Glass, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
