// Constant media: what passes, what scatters once, and that white fog loses nothing.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "core/query/rays.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

class Media : public testing::TestWithParam<KernelUnderTest> {
 protected:
  Media() : family(GetParam().family()) {}
  void check(const std::string& name, double expected, const Scene& scene, int spp = 1024) {
    family.add(name, expected, measure_uniform(scene, GetParam().kind, GetParam().spp(spp)));
  }
  Family family;
};

TEST_P(Media, PassExponentiallyThroughEveryBoundary) {
  const double sigma = 0.6;
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    // The chord is asked of trace(), whose own tests compare it with formulas.
    Scene probe;
    probe.meshes = shapes.meshes;
    add(probe, placed.shape, black(), placed.transform);
    const auto traced = compile(probe, KernelKind::Reference);
    const dvec3 from(0.3, 0.2, 5), direction(-0.03, 0.01, -1);
    const double length = glm::length(direction);
    const auto enter = trace(*traced, {from, direction});
    ASSERT_TRUE(enter);
    // From behind, the same line meets the far side first.
    const auto leave = trace(*traced, {from + 10.0 * direction, -direction});
    ASSERT_TRUE(leave);
    const double chord = (10 - leave->t - enter->t) * length;
    EXPECT_GT(chord, 0.3) << placed.name;

    Scene s = wall_scene(40);
    s.meshes = shapes.meshes;
    add_medium(s, placed.shape, sigma, dvec3(0), placed.transform);
    aim(s, from, from + direction);
    check(std::string("through a ") + placed.name, std::exp(-sigma * chord), s);
    const dvec3 inside = from + direction * (0.5 * (10 - leave->t + enter->t));
    aim(s, inside, inside + direction);
    check(std::string("from within a ") + placed.name, std::exp(-sigma * chord / 2), s);
  }
  family.expect_agreement();
}

TEST_P(Media, OverlappingMediaMultiply) {
  Scene s = wall_scene(40);
  add_medium(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, 0.2, dvec3(0));
  add_medium(s, BoxShape{{-1, -1, -0.5}, {1, 1, 2}}, 0.15, dvec3(0));
  add_medium(s, SphereShape{{0, 0, 0}, 100, {0, 0, 0}}, 0.02, dvec3(0));
  aim(s, {0, 0, 5}, dvec3(0));
  check("three media", std::exp(-0.2 * 2 - 0.15 * 2.5 - 0.02 * 8), s, 2048);
  family.expect_agreement();
}

TEST_P(Media, ThinAndThickMedia) {
  for (const double sigma : {1e-3, 0.05, 4.0}) {
    Scene s = wall_scene(40);
    add_medium(s, BoxShape{{-1, -1, -0.5}, {1, 1, 0.5}}, sigma, dvec3(0));
    aim(s, {0, 0, 5}, dvec3(0));
    check("density " + std::to_string(sigma), std::exp(-sigma), s, sigma > 1 ? 4096 : 1024);
  }
  family.expect_agreement();
}

// A ball of fog around the lit point: every ray to the light and the ray to the camera cross it
// along one radius.
TEST_P(Media, DimTheLightThatIsSampled) {
  for (const bool mesh : {false, true}) {
    const double sigma = 0.5, radius = 1.2;
    Scene s = dark_scene();
    add(s, RectangleShape{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, lambertian(dvec3(0.5)));
    add(s, SphereShape{{1, 3, -1}, 0.8, {0, 0, 0}}, light(dvec3(1)));
    aim(s, {0, 4, 0}, dvec3(0));
    s.camera.look_from.x = -1e-3;
    double expected = 0.5 * 0.64 / 11 * 3 / std::sqrt(11.0);
    if (mesh) {
      // A slab of mesh between: the light is far and small enough to leave at one angle.
      s.objects.pop_back();
      add(s, SphereShape{{0, 300, 0}, 3, {0, 0, 0}}, light(dvec3(1000)));
      Mesh slab;
      for (int i = 0; i < 8; ++i) {
        slab.positions.emplace_back(i & 1 ? 4 : -4, i & 2 ? 1.5 : 0.5, i & 4 ? 4 : -4);
      }
      slab.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
      add_medium(s, MeshShape{add_mesh(s, slab)}, sigma, dvec3(0));
      expected = 0.5 * 1000 * 1e-4 * std::exp(-2 * sigma);
      aim(s, {-1e-3, 4, 0}, dvec3(0));
      // Over the cone of the light the way through the slab is 1 / cos: integrate it.
      const double edge = std::sqrt(1 - 1e-4);
      expected = 0.5 / kPi * 1000 * std::exp(-sigma) * integrate(edge, 1, 100, [&](double c) {
                   return 2 * kPi * c * std::exp(-sigma / c);
                 });
    } else {
      add_medium(s, SphereShape{{0, 0, 0}, radius, {0, 0, 0}}, sigma, dvec3(0));
      expected *= std::exp(-2 * sigma * radius);
    }
    check(mesh ? "through a mesh slab" : "through a ball", expected, s, 2048);
  }
  family.expect_agreement();
}

// One scattering in a ball, then the way out: a double integral of smooth functions. With a camera
// that allows two segments, the second must reach the environment, or the shell that replaces it
// and is sampled as a light.
TEST_P(Media, SingleScatteringInABall) {
  const double sigma = 0.8, albedo = 0.7;
  const double expected = std::exp(-2 * sigma) + integrate(0, 2, 400, [&](double t) {
                            const double r = std::abs(t - 1);  // distance from the centre
                            const double out = integrate(-1, 1, 400, [&](double mu) {
                              const double exit = -r * mu + std::sqrt(1 - r * r * (1 - mu * mu));
                              return 0.5 * std::exp(-sigma * exit);
                            });
                            return albedo * sigma * std::exp(-sigma * t) * out;
                          });
  Scene s = furnace_scene();
  s.render.max_depth = 2;
  add_medium(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, sigma, dvec3(albedo));
  aim(s, {0, 0, 5}, dvec3(0));
  check("environment", expected, s);
  s.environment.color = dvec3(0);
  add(s, SphereShape{{0, 0, 0}, 8, {0, 0, 0}}, light(dvec3(1), true));
  check("shell", expected, s);
  family.expect_agreement();
}

TEST_P(Media, WhiteFogLosesNothing) {
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    Scene s = furnace_scene();
    s.meshes = shapes.meshes;
    add_medium(s, placed.shape, 2, dvec3(1), placed.transform);
    look(s, {0, 0, 4}, dvec3(0), 30);
    check(std::string(placed.name) + " of fog", 1, s, 128);
  }
  // Fog around everything, the camera and white things in it; then lit by a shell.
  for (const bool shell : {false, true}) {
    Scene s = shell ? dark_scene() : furnace_scene();
    add(s, SphereShape{{-0.6, 0, -2}, 0.5, {0, 0, 0}}, lambertian(dvec3(1)));
    add(s, SphereShape{{0.6, 0, -2}, 0.5, {0, 0, 0}}, glass(1.5));
    add(s, BoxShape{{-0.4, -1.2, -2.5}, {0.4, -0.6, -1.6}}, mirror(dvec3(1)));
    if (shell) add(s, SphereShape{{0, 0, 0}, 6, {0, 0, 0}}, light(dvec3(1), true));
    add_medium(s, SphereShape{{0, 0, 0}, 5, {0, 0, 0}}, 0.2, dvec3(1));
    look(s, {0, 0, 1}, {0, -0.2, -2}, 50);
    check(shell ? "fog in a shell" : "fog in an environment", 1, s, 128);
  }
  family.expect_agreement();
}

TEST_P(Media, FillGlass) {
  // Straight through the centre: two Fresnel losses, absorption twice as long as the radius; the
  // light that turns round inside crosses again and again.
  const double sigma = 0.5;
  Scene s = wall_scene(40);
  add(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(1.5));
  add_medium(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, sigma, dvec3(0));
  aim(s, {0, 0, 5}, dvec3(0));
  const double f = fresnel(1, 1.5), t = std::exp(-2 * sigma);
  check("absorbing glass", (1 - f) * (1 - f) * t / (1 - f * f * t * t), s, 2048);
  Scene white = furnace_scene();
  add(white, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(1.5));
  add_medium(white, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, 1.5, dvec3(1));
  look(white, {0, 0, 5}, dvec3(0), 20);
  check("white fog in glass", 1, white, 1024);
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, Media, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
