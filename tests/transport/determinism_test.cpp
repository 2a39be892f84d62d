// A sample is a pure function of scene, seed, pixel and sample index, and the film's sums do not
// depend on their order: the same bits however the work is cut.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "app/proof/build_scene.h"
#include "core/scene/scene_io.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

constexpr int kSize = 40, kSpp = 24;

/// Motion, glass, textures, many shapes; small.
Scene headline() {
  Scene s = load_scene(LIGHTBENCH_SOURCE_DIR "/scenes/cornell-three-lights.json");
  s.render.width = s.render.height = kSize;
  return s;
}

std::uint64_t hash_in_tiles(const RenderScene& scene, int tile_width, int tile_height,
                            const std::vector<int>& passes, unsigned order_seed) {
  std::vector<Work> tiles;
  int first = 0;
  for (const int count : passes) {
    for (int y = 0; y < kSize; y += tile_height) {
      for (int x = 0; x < kSize; x += tile_width) {
        tiles.push_back({x, y, std::min(x + tile_width, kSize), std::min(y + tile_height, kSize),
                         static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), 1});
      }
    }
    first += count;
  }
  std::shuffle(tiles.begin(), tiles.end(), std::mt19937(order_seed));
  Film film(kSize, kSize, scene.film_unit);
  Counters counters;
  for (const Work& work : tiles) render(scene, work, film.view(), counters);
  EXPECT_EQ(counters.paths, static_cast<std::uint64_t>(kSize) * kSize * kSpp);
  EXPECT_EQ(counters.non_finite, 0U);
  return film.hash();
}

TEST(Determinism, TilesOrderAndPassesLeaveNoTrace) {
  for (const KernelKind kind : {KernelKind::Auto, KernelKind::Reference}) {
    const auto scene = compile(headline(), kind);
    const std::uint64_t whole = hash_in_tiles(*scene, kSize, kSize, {kSpp}, 1);
    EXPECT_EQ(hash_in_tiles(*scene, 8, 8, {kSpp}, 2), whole);
    EXPECT_EQ(hash_in_tiles(*scene, 7, 3, {kSpp}, 3), whole);
    EXPECT_EQ(hash_in_tiles(*scene, kSize, 1, {1, 1, 2, 4, 16}, 4), whole);
    EXPECT_EQ(hash_in_tiles(*scene, 16, 16, {10, 14}, 5), whole);
    EXPECT_EQ(hash_in_tiles(*compile(headline(), kind), kSize, kSize, {kSpp}, 6), whole)
        << "compiled again";
  }
}

TEST(Determinism, FloatKernelsGiveTheSameBits) {
  std::vector<Scene> scenes{headline()};
  for (const char* name :
       {"features/media", "features/shape-lights", "features/textures",
        "features/metal-fuzz-and-roughness", "features/instances", "features/depth-of-field"}) {
    scenes.push_back(load_scene(std::string(LIGHTBENCH_SOURCE_DIR "/scenes/") + name + ".json"));
    scenes.back().render.width = scenes.back().render.height = kSize;
  }
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const std::uint64_t scalar =
        hash_in_tiles(*compile(scenes[i], KernelKind::Scalar), kSize, kSize, {kSpp}, 1);
    for (const KernelKind kind : {KernelKind::Avx2, KernelKind::Avx512}) {
      if (!kernel_supported(kind)) continue;
      EXPECT_EQ(hash_in_tiles(*compile(scenes[i], kind), kSize, kSize, {kSpp}, 1), scalar)
          << "scene " << i << " " << kernel_name(kind);
    }
  }
}

TEST(Determinism, SeedsDiffer) {
  Scene s = headline();
  std::vector<std::uint64_t> hashes;
  for (const std::uint32_t seed : {0U, 1U, 2U, 0x80000000U}) {
    s.render.seed = seed;
    hashes.push_back(hash_in_tiles(*compile(s, KernelKind::Auto), kSize, kSize, {kSpp}, 1));
  }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::adjacent_find(hashes.begin(), hashes.end()), hashes.end());
}

TEST(Determinism, CropShowsTheSamePixels) {
  Scene s = headline();
  const Film whole = render_film(s, KernelKind::Auto, kSpp);
  s.render.crop = {13, 7, 9, 21};
  const Film part = render_film(s, KernelKind::Auto, kSpp);
  ASSERT_EQ(part.width(), 9);
  ASSERT_EQ(part.height(), 21);
  for (std::size_t y = 0; y < 21; ++y) {
    for (std::size_t x = 0; x < 9; ++x) {
      const FilmPixel& a = part.pixels()[y * 9 + x];
      const FilmPixel& b = whole.pixels()[(y + 7) * kSize + x + 13];
      EXPECT_EQ(a.r, b.r);
      EXPECT_EQ(a.luminance_squared, b.luminance_squared);
    }
  }
}

TEST(FilmSums, EqualTheSamplesOneByOne) {
  const int spp = 200, size = 4;
  Scene s = headline();
  s.render.width = s.render.height = size;
  for (const KernelKind kind : {KernelKind::Auto, KernelKind::Reference}) {
    const auto scene = compile(s, kind);
    std::vector<double> sum(size * size), squares(size * size);
    for (int i = 0; i < spp; ++i) {
      const Film one = render_film(*scene, 1, i);
      for (std::size_t p = 0; p < sum.size(); ++p) {
        const glm::dvec3 v = pixel_mean(one, p, 1);
        const double y = 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z;
        sum[p] += y;
        squares[p] += y * y;
      }
    }
    const Film film = render_film(*scene, spp);
    const Image mean = film.mean(spp);
    const std::vector<float> variance = film.variance(spp);
    for (std::size_t p = 0; p < sum.size(); ++p) {
      const double y = 0.2126 * static_cast<double>(mean.rgb[3 * p]) +
                       0.7152 * static_cast<double>(mean.rgb[3 * p + 1]) +
                       0.0722 * static_cast<double>(mean.rgb[3 * p + 2]);
      EXPECT_NEAR(y, sum[p] / spp, 1e-6 * sum[p] / spp);
      const double expected = (squares[p] - sum[p] * sum[p] / spp) / (spp - 1);
      // The squares are summed in steps of 2^-24 unit^2.
      const double step = scene->film_unit * scene->film_unit / (1 << kFilmSquareBits);
      EXPECT_NEAR(variance[p], expected, 1e-5 * expected + step);
    }
  }
}

TEST(FilmSums, StayAccurateAtAMillionSamples) {
  const int spp = 1'000'000;
  Scene s = furnace_scene(1, 2);
  add(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, mirror({0.7, 0.1, 1e-3}));
  look(s, {0, 0, 5}, glm::dvec3(0), 5);
  const Film film = render_film(s, KernelKind::Auto, spp);
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3 p = pixel_mean(film, i, spp);
    // The rounding of one float; the film adds none (a float sum would be 1 % off).
    EXPECT_NEAR(p.x, 0.7, 1e-7);
    EXPECT_NEAR(p.y, 0.1, 1e-8);
    EXPECT_NEAR(p.z, 1e-3, 2e-10);
  }
}

TEST(FilmSums, SamplesBeyondTheRangeAreDroppedCountedAndLocated) {
  // Seen from within two nested balls of index 100, the world is 10^8 times brighter: beyond the
  // film. The left half of the picture looks at a light in front of them instead.
  Scene s = furnace_scene(1, 8);
  add(s, SphereShape{{0, 0, 0}, 2, {0, 0, 0}}, glass(100));
  add(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(100));
  add(s, RectangleShape{{-2, -2, -0.5}, {2, 0, 0}, {0, 4, 0}}, light(glm::dvec3(0.5), true));
  look(s, glm::dvec3(0), {0, 0, -1}, 20);
  s.camera.up = glm::dvec3(0, 1, 0);
  s.render.seed = 3;
  for (const KernelKind kind : {KernelKind::Auto, KernelKind::Reference}) {
    const auto scene = compile(s, kind);
    Film film(8, 8, scene->film_unit);
    Counters counters;
    render(*scene, {0, 0, 8, 8, 0, 4, 1}, film.view(), counters);
    EXPECT_EQ(counters.paths, 256U);
    ASSERT_GT(counters.non_finite, 0U);
    EXPECT_LE(counters.non_finite, 128U);
    EXPECT_GE(counters.bad.x, 4) << "the left half is sound";
    // The sample it names, replayed alone, is bad again.
    Counters again;
    Film replay(8, 8, scene->film_unit);
    render(*scene,
           {counters.bad.x, counters.bad.y, counters.bad.x + 1, counters.bad.y + 1,
            counters.bad.sample, 1, 1},
           replay.view(), again);
    EXPECT_EQ(again.non_finite, 1U);
    EXPECT_EQ(again.bad.x, counters.bad.x);
    EXPECT_EQ(again.bad.sample, counters.bad.sample);
    // What was dropped adds nothing.
    for (std::size_t i = 0; i < 64; ++i) {
      const glm::dvec3 p = pixel_mean(film, i, 4);
      EXPECT_GE(p.x, 0);
      if (i % 8 < 4) {
        EXPECT_NEAR(p.x, 0.5, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace lightbench
