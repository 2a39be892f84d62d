// A path written down is the path that was rendered.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/common.hpp>
#include <limits>

#include "core/query/path.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

Scene stored_scene(const char* name) {
  Scene scene = load_scene(std::filesystem::path(LIGHTBENCH_SOURCE_DIR) / "scenes" / name);
  scene.render.width = 12;
  scene.render.height = 8;
  scene.render.crop = {};
  return scene;
}

TEST(PathRecords, SumIsTheFilmsSampleToTheLastBit) {
  int vertices = 0, lights = 0, emissions = 0, media = 0, roulettes = 0;
  for (const char* name :
       {"cornell-three-lights.json", "cornell-smoke.json", "features/shape-lights.json",
        "features/shape-mesh.json", "features/glass.json", "features/environment-image.json",
        "features/depth-of-field.json", "bouncing-spheres.json"}) {
    const Scene scene = stored_scene(name);
    for (const KernelKind kind : {KernelKind::Auto, KernelKind::Scalar, KernelKind::Reference}) {
      const auto compiled = compile(scene, kind);
      for (const std::uint32_t sample : {0U, 5U}) {
        // The whole picture at once, all lanes busy.
        Film film(12, 8, compiled->film_unit);
        Counters counters;
        render(*compiled, {0, 0, 12, 8, sample, 1, 1}, film.view(), counters);
        std::uint64_t rays = 0;
        for (int y = 0; y < 8; ++y) {
          for (int x = 0; x < 12; ++x) {
            const PathRecord path = trace_path(*compiled, {x, y, sample});
            const FilmPixel& pixel = film.pixels()[static_cast<std::size_t>(y * 12 + x)];
            ASSERT_EQ(path.film.r, pixel.r) << name;
            ASSERT_EQ(path.film.g, pixel.g) << name;
            ASSERT_EQ(path.film.b, pixel.b) << name;
            ASSERT_EQ(path.film.luminance_squared, pixel.luminance_squared) << name;
            rays += path.vertices.size();
            // What the vertices say they add is the sum, up to its roundings.
            glm::dvec3 sum(0);
            for (std::size_t i = 0; i < path.vertices.size(); ++i) {
              const PathVertex& v = path.vertices[i];
              ASSERT_EQ(v.end.has_value(), i + 1 == path.vertices.size()) << name;
              ++vertices;
              if (v.emission) {
                sum += v.throughput * v.emission->radiance * v.emission->weight;
                ++emissions;
              }
              if (v.light) {
                sum += v.light->added;
                lights += v.light->visible ? 1 : 0;
              }
              media += v.in_medium ? 1 : 0;
              roulettes += v.survival < 1 ? 1 : 0;
              for (int k = 0; k < 3; ++k) {
                ASSERT_NEAR(sum[k], v.radiance[k], 1e-5 * std::abs(sum[k]) + 1e-12) << name;
              }
            }
            ASSERT_EQ(path.vertices.back().radiance, path.radiance);
          }
        }
        EXPECT_EQ(rays, counters.rays) << name;
      }
    }
  }
  EXPECT_GT(vertices, 5000);
  EXPECT_GT(lights, 1000);
  EXPECT_GT(emissions, 500);
  EXPECT_GT(media, 100);
  EXPECT_GT(roulettes, 100);
}

TEST(PathRecords, PixelsOutsideThePictureAreRefused) {
  const auto compiled = compile(stored_scene("cornell-box.json"), KernelKind::Auto);
  EXPECT_THROW(trace_path(*compiled, {12, 0, 0}), std::exception);
  EXPECT_THROW(trace_path(*compiled, {0, -1, 0}), std::exception);
}

TEST(DroppedSamples, AreCountedByCauseAndNamedWhateverTheOrder) {
  Counters a, b;
  a.drop({7, 3, 2}, Fault::Infinite);
  a.drop({1, 9, 2}, Fault::Negative);
  b.drop({5, 5, 1}, Fault::NotANumber);
  b.drop({0, 0, 4}, Fault::NotANumber);
  Counters ab = a, ba = b;
  ab += b;
  ba += a;
  ab += Counters{};
  for (const Counters& c : {ab, ba}) {
    EXPECT_EQ(c.non_finite, 4U);
    EXPECT_EQ(c.faults[static_cast<int>(Fault::NotANumber)], 2U);
    EXPECT_EQ(c.faults[static_cast<int>(Fault::Infinite)], 1U);
    EXPECT_EQ(c.faults[static_cast<int>(Fault::Negative)], 1U);
    EXPECT_EQ(c.bad.x, 5);
    EXPECT_EQ(c.bad.sample, 1U);
    EXPECT_EQ(c.bad_fault, Fault::NotANumber);
  }
  EXPECT_EQ(a.bad.x, 7) << "row by row: y decides before x";
}

TEST(DroppedSamples, OfEveryCauseAreNamedByRenderingAndShownByTheirPath) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const std::pair<glm::dvec3, Fault> cases[] = {{{0.5, kNan, 0.5}, Fault::NotANumber},
                                                {{0.5, 0.5, kInf}, Fault::Infinite},
                                                {{-0.5, 0.5, 0.5}, Fault::Negative}};
  for (const auto& [color, fault] : cases) {
    // No file can say this: validate() would refuse it.
    Scene scene;
    scene.render.width = 3;
    scene.render.height = 2;
    scene.environment.color = color;
    for (const KernelKind kind : {KernelKind::Auto, KernelKind::Scalar, KernelKind::Reference}) {
      const auto compiled = compile(scene, kind);
      EXPECT_GT(compiled->film_unit, 0) << "infinite light has no size to measure it by";
      Film film(3, 2, 1.0);
      Counters counters;
      render(*compiled, {1, 1, 3, 2, 5, 4, 1}, film.view(), counters);
      EXPECT_EQ(counters.non_finite, 8U);
      EXPECT_EQ(counters.faults[static_cast<int>(fault)], 8U) << fault_name(fault);
      EXPECT_EQ(counters.bad_fault, fault);
      EXPECT_EQ(counters.bad.x, 1);
      EXPECT_EQ(counters.bad.y, 1);
      EXPECT_EQ(counters.bad.sample, 5U);
      for (const FilmPixel& sum : film.pixels()) {
        EXPECT_EQ(sum.r | sum.g | sum.b | sum.luminance_squared, 0) << "nothing of it is added";
      }
      const PathRecord path = trace_path(*compiled, counters.bad);
      ASSERT_TRUE(path.fault.has_value()) << fault_name(fault);
      EXPECT_EQ(*path.fault, fault);
    }
  }
}

}  // namespace
}  // namespace lightbench
