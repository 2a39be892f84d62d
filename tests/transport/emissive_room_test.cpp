// Closed rooms whose walls emit Le and reflect rho: every ray sees Le + rho Le + rho^2 Le + ...,
// cut after max_depth segments. The whole of the transport (light sampling, its weights, depth,
// roulette) in one number, from within every closed shape.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "app/proof/build_scene.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

class EmissiveRoom : public testing::TestWithParam<KernelUnderTest> {
 protected:
  static Material glowing(const glm::dvec3& albedo, double radiance) {
    Material m = lambertian(albedo);
    m.emissive = glm::dvec3(radiance);
    m.two_sided = true;
    return m;
  }
  /// Seen from within.
  static Scene room(const Scene& shapes, const PlacedShape& placed, const glm::dvec3& albedo) {
    Scene s = dark_scene();
    s.meshes = shapes.meshes;
    add(s, placed.shape, glowing(albedo, 0.75), placed.transform);
    look(s, {0.05, 0.1, -0.08}, {1, -0.3, 0.5}, 100);
    return s;
  }
};

TEST_P(EmissiveRoom, ShowsTheGeometricSeries) {
  Family family = GetParam().family();
  const glm::dvec3 albedo(0.75, 0.5, 0.2);
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    family.add(placed.name, 0.75 / (glm::dvec3(1) - albedo),
               measure_uniform(room(shapes, placed, albedo), GetParam().kind, GetParam().spp(256)));
  }
  family.expect_agreement();
}

TEST_P(EmissiveRoom, MaxDepthIsTheNumberOfSegments) {
  Family family = GetParam().family();
  const double rho = 0.6;
  Scene shapes;
  const std::vector<PlacedShape> all = closed_shapes(shapes);
  for (const PlacedShape& placed : {all[0], all[2], all[6]}) {
    for (const int depth : {1, 2, 3, 5, 12}) {
      for (const int roulette : {1, 4, 100}) {
        Scene s = room(shapes, placed, glm::dvec3(rho));
        s.render.max_depth = depth;
        s.render.roulette_depth = roulette;
        family.add(std::string(placed.name) + " depth " + std::to_string(depth) +
                       " roulette from " + std::to_string(roulette),
                   0.75 * (1 - std::pow(rho, depth)) / (1 - rho),
                   measure_uniform(s, GetParam().kind, GetParam().spp(256)));
      }
    }
  }
  family.expect_agreement();
}

// Kirchhoff's law: where everything emits Le = 1 - rho times the radiance around it, or absorbs
// nothing (the glass), nothing can be told from anything else.
TEST_P(EmissiveRoom, ObjectsOfTheSameGlowDisappear) {
  Family family = GetParam().family();
  const glm::dvec3 albedo(0.5);
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    Scene s = dark_scene();
    s.meshes = shapes.meshes;
    Transform small = placed.transform;
    small.scale *= 0.4;
    add(s, BoxShape{{-2, -1, -2}, {2, 2, 2}}, glowing(albedo, 1));
    add(s, placed.shape, glowing(albedo, 1), small);
    add(s, SphereShape{{1.2, 0, 0.5}, 0.4, {0, 0, 0}}, glass(1.5));
    look(s, {1.5, 1.2, -1.7}, {0, 0, 0}, 60);
    family.add(std::string("room with a ") + placed.name, 2,
               measure_uniform(s, GetParam().kind, GetParam().spp(256)));
  }
  family.expect_agreement();
}

constexpr std::pair<const char*, Strategy> kStrategies[] = {
    {"mis", Strategy::Mis}, {"lights", Strategy::Lights}, {"bsdf", Strategy::Bsdf}};

/// A black ball far away, which makes coordinates coarser.
void add_far_ball(Scene& s) { add(s, SphereShape{{700, -900, 400}, 1, {0, 0, 0}}, black()); }

// A convex solid never lights its own outside, whichever way its points are rounded.
TEST_P(EmissiveRoom, IsSeenFromOutsideAsItGlows) {
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const bool coarse : {false, true}) {
      for (const auto& [name, strategy] : kStrategies) {
        Scene s = dark_scene();
        s.meshes = shapes.meshes;
        add(s, placed.shape, glowing(glm::dvec3(0.5), 0.75), placed.transform);
        if (coarse) add_far_ball(s);
        look(s, {4, 3, -5}, {0.05, 0.1, -0.08}, 5);
        s.render.strategy = strategy;
        const int spp = GetParam().spp(64);
        const Film film = render_film(s, GetParam().kind, spp);
        const auto pixels = static_cast<std::size_t>(film.width() * film.height());
        int other = 0;
        for (std::size_t i = 0; i < pixels; ++i) {
          if (pixel_mean(film, i, spp) != glm::dvec3(0.75)) ++other;
        }
        EXPECT_EQ(other, 0) << placed.name << (coarse ? ", coarse, by " : ", by ") << name;
      }
    }
  }
}

// Walls are in the way of light from outside, be it sampled from the wall itself. What float lets
// in comes along a curved wall, where rounding leaves no chord, and past edges: by many seeds at
// most 3e-8 of the light (mean of the picture over radiance outside), a few samples of a picture or
// none. One sample past an edge is 1.4e-7 of these four pictures.
TEST_P(EmissiveRoom, LetsNothingInFromOutside) {
  constexpr int kSeeds = 4;
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const auto& [name, strategy] : kStrategies) {
      Scene s = dark_scene();
      s.meshes = shapes.meshes;
      add(s, placed.shape, lambertian(glm::dvec3(0.8)), placed.transform);
      for (const glm::dvec3& place : {glm::dvec3(5, 4, -3), glm::dvec3(-4, -5, 2)}) {
        add(s, SphereShape{place, 1, {0, 0, 0}}, light(glm::dvec3(50), true));
      }
      look(s, {0.05, 0.1, -0.08}, {1, -0.3, 0.5}, 100);
      s.render.strategy = strategy;
      const int spp = GetParam().spp(64);
      double mean = 0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        s.render.seed = static_cast<std::uint32_t>(seed);
        const Film film = render_film(s, GetParam().kind, spp);
        const auto pixels = static_cast<std::size_t>(film.width() * film.height());
        for (std::size_t i = 0; i < pixels; ++i) {
          mean += pixel_mean(film, i, spp).y / static_cast<double>(pixels * kSeeds);
        }
      }
      EXPECT_LE(mean, GetParam().kind == KernelKind::Reference ? 0 : 1e-7 * 50)
          << placed.name << " by " << name;
    }
  }
}

// Light sampling from its own inner side has to find all that the paths' own rays would.
TEST_P(EmissiveRoom, ShowsTheSeriesByAnyStrategy) {
  Family family = GetParam().family();
  const double rho = 0.6;
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const bool coarse : {false, true}) {
      for (const auto& [name, strategy] : kStrategies) {
        Scene s = room(shapes, placed, glm::dvec3(rho));
        if (coarse) add_far_ball(s);
        s.render.max_depth = 3;
        s.render.strategy = strategy;
        family.add(std::string(placed.name) + (coarse ? ", coarse, by " : ", by ") + name,
                   0.75 * (1 + rho + rho * rho),
                   measure_uniform(s, GetParam().kind, GetParam().spp(256)));
      }
    }
  }
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, EmissiveRoom, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
