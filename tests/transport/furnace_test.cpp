// Objects in an environment of radiance 1 from everywhere. A convex object returns exactly what its
// surface reflects of a full hemisphere: any ray that met its own surface again, leaked through it
// or started on the wrong side would show.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

class Furnace : public testing::TestWithParam<KernelUnderTest> {};

/// Views that see a closed shape with edges, caps and corners from all sides.
const glm::dvec3 kViews[] = {{0, 0, 6}, {4, 3, -4}, {-2, -6, 1}};

double lowest_and_highest(const Film& film, int spp, double& highest) {
  double lowest = 1e300;
  highest = 0;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const glm::dvec3 p = pixel_mean(film, i, spp);
    lowest = std::min({lowest, p.x, p.y, p.z});
    highest = std::max({highest, p.x, p.y, p.z});
  }
  return lowest;
}

TEST_P(Furnace, ConvexLambertianReflectsItsAlbedoAtEveryPointAndSample) {
  const int spp = GetParam().spp(64);
  const glm::dvec3 albedo(0.8, 0.5, 0.3);
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const glm::dvec3& from : kViews) {
      Scene s = furnace_scene(1, 48);
      s.meshes = shapes.meshes;
      add(s, placed.shape, lambertian(albedo), placed.transform);
      look(s, from, glm::dvec3(0), 30);
      const Film film = render_film(s, GetParam().kind, spp);
      // Each sample is the albedo or, past the outline, 1: pixels lie between, many on the albedo.
      std::size_t on_object = 0;
      for (std::size_t i = 0; i < film.pixels().size(); ++i) {
        const glm::dvec3 p = pixel_mean(film, i, spp);
        // The pixel's share of object follows from one channel, the others must agree with it.
        const double share = (1 - p.z) / (1 - albedo.z);
        EXPECT_GE(share, -1e-5) << placed.name;
        EXPECT_LE(share, 1 + 1e-5) << placed.name;
        EXPECT_NEAR(p.x, 1 - share * (1 - albedo.x), 1e-5) << placed.name;
        EXPECT_NEAR(p.y, 1 - share * (1 - albedo.y), 1e-5) << placed.name;
        on_object += share > 1 - 1e-5;
      }
      EXPECT_GT(on_object, film.pixels().size() / 10) << placed.name;
    }
  }
}

TEST_P(Furnace, SmoothMetalReflectsItsReflectance) {
  const int spp = GetParam().spp(64);
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    Scene s = furnace_scene(1, 48);
    s.meshes = shapes.meshes;
    add(s, placed.shape, mirror({0.9, 0.6, 0.2}), placed.transform);
    look(s, kViews[1], glm::dvec3(0), 30);
    const Film film = render_film(s, GetParam().kind, spp);
    double highest;
    EXPECT_NEAR(lowest_and_highest(film, spp, highest), 0.2, 2e-6) << placed.name;
    EXPECT_NEAR(highest, 1, 1e-5) << placed.name;
  }
}

TEST_P(Furnace, GlassLosesNothing) {
  const int spp = GetParam().spp(256);
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const double ior : {1.5, 1 / 1.5}) {
      Scene s = furnace_scene();
      s.meshes = shapes.meshes;
      // Without roulette every path brings exactly the environment, whatever way it took.
      s.render.roulette_depth = s.render.max_depth;
      add(s, placed.shape, glass(ior), placed.transform);
      look(s, kViews[1], glm::dvec3(0), 25);
      double highest;
      const double lowest = lowest_and_highest(render_film(s, GetParam().kind, spp), spp, highest);
      EXPECT_NEAR(lowest, 1, 2e-5) << placed.name << " " << ior;
      EXPECT_NEAR(highest, 1, 2e-5) << placed.name << " " << ior;
    }
  }
}

TEST_P(Furnace, RoughMetalReflectsTheSingleScatteringAlbedo) {
  Family family = GetParam().family();
  for (const double roughness : {0.2, 0.5, 1.0}) {
    for (const double degrees : {0.0, 45.0, 75.0}) {
      const double angle = degrees * 3.14159265358979 / 180;
      Scene s = furnace_scene();
      add(s, RectangleShape{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}},
          rough_metal({1, 0.7, 0.2}, roughness));
      aim(s, 5.0 * glm::dvec3(std::sin(angle), std::cos(angle), 0), glm::dvec3(0));
      const double albedo = ggx_albedo(std::cos(angle), roughness * roughness);
      EXPECT_LE(albedo, 1);
      family.add("roughness " + std::to_string(roughness) + " at " + std::to_string(degrees),
                 albedo * glm::dvec3(1, 0.7, 0.2),
                 measure_uniform(s, GetParam().kind, GetParam().spp(1024)));
    }
  }
  family.expect_agreement();
}

TEST_P(Furnace, FuzzyMetalReflectsWhatStaysAboveTheSurface) {
  Family family = GetParam().family();
  for (const double fuzz : {0.1, 0.4, 1.0}) {
    for (const double degrees : {0.0, 60.0, 85.0}) {
      const double angle = degrees * 3.14159265358979 / 180;
      Scene s = furnace_scene();
      add(s, RectangleShape{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, fuzzy_metal({1, 0.7, 0.2}, fuzz));
      aim(s, 5.0 * glm::dvec3(std::sin(angle), std::cos(angle), 0), glm::dvec3(0));
      family.add("fuzz " + std::to_string(fuzz) + " at " + std::to_string(degrees),
                 fuzz_share_above(std::cos(angle), fuzz) * glm::dvec3(1, 0.7, 0.2),
                 measure_uniform(s, GetParam().kind, GetParam().spp(512)));
    }
  }
  family.expect_agreement();
}

TEST_P(Furnace, NoMetalReturnsMoreThanItGets) {
  // With fewer, some pixel's samples are all absorbed.
  const int spp = std::max(GetParam().spp(64), 8);
  for (const Material& m : {rough_metal(glm::dvec3(1), 0.1), rough_metal(glm::dvec3(1), 0.5),
                            rough_metal(glm::dvec3(1), 1), fuzzy_metal(glm::dvec3(1), 0.05),
                            fuzzy_metal(glm::dvec3(1), 1)}) {
    Scene shapes;
    for (const PlacedShape& placed : closed_shapes(shapes)) {
      Scene s = furnace_scene(1, 24);
      s.meshes = shapes.meshes;
      add(s, placed.shape, m, placed.transform);
      look(s, kViews[2], glm::dvec3(0), 30);
      double highest;
      EXPECT_GT(lowest_and_highest(render_film(s, GetParam().kind, spp), spp, highest), 0.1);
      EXPECT_LE(highest, 1 + 1e-5) << placed.name << " " << m.roughness << " " << m.fuzz;
    }
  }
}

// The same hemisphere of radiance 1, now from a black shell that emits inwards: light sampling and
// its weights against sampling the surface must add up to what the environment gave without them.
TEST_P(Furnace, AnEmittingShellEqualsTheEnvironment) {
  Family family = GetParam().family();
  const double angle = 0.9;
  const Material materials[] = {lambertian(glm::dvec3(0.5)), rough_metal(glm::dvec3(1), 0.3),
                                rough_metal(glm::dvec3(1), 0.8), fuzzy_metal(glm::dvec3(1), 0.5)};
  const double expected[] = {0.5, ggx_albedo(std::cos(angle), 0.09),
                             ggx_albedo(std::cos(angle), 0.64),
                             fuzz_share_above(std::cos(angle), 0.5)};
  Scene shells;
  for (const PlacedShape& shell : closed_shapes(shells)) {
    for (std::size_t i = 0; i < std::size(materials); ++i) {
      Scene s = dark_scene();
      s.meshes = shells.meshes;
      add(s, DiscShape{{0, 0, 0}, {0, 1, 0}, 0.05}, materials[i]);
      add(s, shell.shape, light(glm::dvec3(1), true), shell.transform);
      aim(s, 0.2 * glm::dvec3(std::sin(angle), std::cos(angle), 0), glm::dvec3(0));
      family.add(std::string(shell.name) + " material " + std::to_string(i), expected[i],
                 measure_uniform(s, GetParam().kind, GetParam().spp(256)));
    }
  }
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, Furnace, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
