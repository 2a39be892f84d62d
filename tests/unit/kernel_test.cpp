// The kernels against each other: the float ones give the same film to the last bit, however the
// work is divided; the reference gives the same picture up to float's rounding.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/compile/render_scene.h"
#include "tests/unit/changed_view.h"
#include "tests/unit/small_scenes.h"

namespace lightbench {
namespace {

Film film_of(const RenderScene& scene, std::uint32_t samples, Counters* counters = nullptr) {
  Film film(scene.crop.width, scene.crop.height, scene.film_unit);
  Counters ignored;
  render(scene, {0, 0, film.width(), film.height(), 0, samples, 1}, film.view(),
         counters != nullptr ? *counters : ignored);
  return film;
}

/// The kernels of one precision against its plain one.
void expect_same_bits(KernelKind plain) {
  int compared = 0;
  for (const auto& [name, scene] : small_scenes(32, 24)) {
    Counters scalar_count;
    const std::uint64_t scalar = film_of(*compile(scene, plain), 3, &scalar_count).hash();
    EXPECT_EQ(scalar_count.paths, 32U * 24 * 3) << name;
    EXPECT_EQ(scalar_count.non_finite, 0U) << name;
    for (const KernelKind kernel : kKernels) {
      if (!kernel_supported(kernel) || kernel == plain ||
          precision_of(kernel) != precision_of(plain)) {
        continue;
      }
      Counters count;
      EXPECT_EQ(film_of(*compile(scene, kernel), 3, &count).hash(), scalar)
          << name << " in " << kernel_name(kernel);
      EXPECT_EQ(count.rays, scalar_count.rays) << name;
      EXPECT_EQ(count.shadow_rays, scalar_count.shadow_rays) << name;
      ++compared;
    }
  }
  if (compared == 0) GTEST_SKIP() << "this processor runs the plain kernels only";
}

TEST(Kernel, FloatKernelsAgreeToTheLastBit) { expect_same_bits(KernelKind::Scalar); }

TEST(Kernel, DoubleKernelsAgreeToTheLastBit) { expect_same_bits(KernelKind::Reference); }

// Same samples, so the difference is rounding: most pixels agree to a few parts in ten thousand. A
// path whose choice hangs on rounding (an edge, a Fresnel or roulette number, a free flight) goes
// another way, so some pixels differ as pixels do from one sample to the next.
TEST(Kernel, TheReferenceShowsTheSamePicture) {
  for (const auto& [name, scene] : small_scenes(32, 24)) {
    constexpr std::uint32_t kSamples = 4;
    const Image a = film_of(*compile(scene, KernelKind::Scalar), kSamples).mean(kSamples);
    const Image b = film_of(*compile(scene, KernelKind::Reference), kSamples).mean(kSamples);
    double sum_a = 0, sum_b = 0;
    int close = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
      const auto x = static_cast<double>(a.rgb[i]), y = static_cast<double>(b.rgb[i]);
      sum_a += x;
      sum_b += y;
      close += std::abs(x - y) <= 1e-3 * std::max(x, y) + 1e-6 ? 1 : 0;
    }
    const double share = static_cast<double>(close) / static_cast<double>(a.rgb.size());
    EXPECT_GT(share, 0.98) << name;
    EXPECT_NEAR(sum_a / sum_b, 1, 1e-3) << name;
  }
}

TEST(Kernel, WorkMayBeDividedInAnyWay) {
  for (const auto& [name, scene] : small_scenes(32, 24)) {
    const auto compiled = compile(scene, KernelKind::Auto);
    const std::uint64_t whole = film_of(*compiled, 4).hash();
    Film film(32, 24, compiled->film_unit);
    Counters counters;
    // Tiles from the last to the first; samples in two parts, the later first.
    for (const std::uint32_t first : {1U, 0U}) {
      for (int y = 16; y >= 0; y -= 8) {
        for (int x = 22; x >= 0; x -= 11) {
          render(*compiled, {x, y, std::min(x + 11, 32), y + 8, first, first == 0 ? 1U : 3U, 1},
                 film.view(), counters);
        }
      }
    }
    EXPECT_EQ(film.hash(), whole) << name;
    EXPECT_EQ(counters.paths, 32U * 24 * 4) << name;
  }
}

TEST(Kernel, ColumnsHoldWhatTheTablesHold) {
  int columns = 0;
  for (const auto& [name, scene] : small_scenes(32, 24)) {
    for (const KernelKind kernel : kKernels) {
      if (!kernel_supported(kernel)) continue;
      const auto compiled = compile(scene, kernel);
      const RenderScene gathered = with_changed_view(*compiled, [&columns](auto& view) {
        const auto drop = [&columns](auto& of) {
          if (std::exchange(of.column, nullptr) != nullptr) ++columns;
        };
        drop(view.offset);
        drop(view.material);
        drop(view.first_light);
        drop(view.light_primitive);
      });
      EXPECT_EQ(film_of(*compiled, 3).hash(), film_of(gathered, 3).hash())
          << name << " in " << kernel_name(kernel);
    }
  }
  EXPECT_GE(columns, 40) << "few scenes with few objects";
}

TEST(Kernel, ACropIsAWindowOfTheWholeCamera) {
  Scene scene = small_scenes(32, 24)[0].second;
  scene.render.width = 64;
  scene.render.height = 48;
  const Image whole = film_of(*compile(scene, KernelKind::Auto), 64).mean(64);
  scene.render.crop = {16, 12, 32, 24};
  const Image crop = film_of(*compile(scene, KernelKind::Auto), 64).mean(64);
  ASSERT_EQ(crop.width, 32);
  ASSERT_EQ(crop.height, 24);
  double difference = 0, total = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      const auto at = [](const Image& i, int px, int py) {
        const auto row = static_cast<std::size_t>(py) * static_cast<std::size_t>(i.width);
        return static_cast<double>(i.rgb[3 * (row + static_cast<std::size_t>(px)) + 1]);
      };
      const double w = at(whole, x + 16, y + 12), c = at(crop, x, y);
      difference += std::abs(w - c);
      total += w;
    }
  }
  EXPECT_LT(difference, 0.35 * total);
}

TEST(Kernel, SeedsGiveOtherSamplesOfTheSamePicture) {
  Scene scene = small_scenes(32, 24)[0].second;
  const Film a = film_of(*compile(scene, KernelKind::Auto), 4);
  scene.render.seed += 1;
  const Film b = film_of(*compile(scene, KernelKind::Auto), 4);
  EXPECT_NE(a.hash(), b.hash());
}

TEST(Kernel, NamesAndSupportAreConsistent) {
  EXPECT_TRUE(kernel_supported(KernelKind::Auto));
  EXPECT_TRUE(kernel_supported(KernelKind::Scalar));
  EXPECT_TRUE(kernel_supported(KernelKind::Reference));
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    EXPECT_TRUE(kernel_supported(best_kernel(precision)));
    EXPECT_EQ(precision_of(best_kernel(precision)), precision);
  }
  Scene scene;
  scene.render.width = scene.render.height = 2;
  EXPECT_EQ(compile(scene, KernelKind::Auto)->kernel, best_kernel(Precision::Float));
  EXPECT_STREQ(kernel_name(KernelKind::Avx2), "avx2");
  EXPECT_STREQ(kernel_name(KernelKind::Avx2Double), "avx2-double");
}

/// One object that shines in the colours of a 3-D checker, seen from above.
Scene shining_checker(const Shape& shape, double scale) {
  Scene scene;
  scene.render.width = scene.render.height = 24;
  scene.render.max_depth = 1;
  scene.camera.look_from = {0.1, 4, 0.2};
  scene.camera.look_at = {0.1, 0, 0.2};
  scene.camera.up = {0, 0, -1};
  scene.camera.vfov = 8;
  scene.textures.emplace_back();
  scene.textures[0].kind = TextureKind::Checker;
  scene.textures[0].scale = scale;
  scene.materials.emplace_back();
  scene.materials[0].kind = MaterialKind::Emissive;
  scene.materials[0].emissive = glm::dvec3(1);
  scene.materials[0].emissive_texture = 0;
  scene.materials[0].two_sided = true;
  Object object;
  object.shape = shape;
  object.material = 0;
  scene.objects = {object};
  return scene;
}

void expect_uniform(const Scene& scene, KernelKind kernel, float value) {
  const Image image = film_of(*compile(scene, kernel), 4).mean(4);
  for (const float x : image.rgb) ASSERT_NEAR(x, value, 1e-5) << kernel_name(kernel);
}

TEST(SolidTextures, AFaceBetweenTwoCellsShowsTheOneBelowIt) {
  for (const KernelKind kernel : {KernelKind::Scalar, KernelKind::Reference}) {
    // The plane y = 0, moved and turned; the cells are so large that only y tells them apart.
    Scene floor = shining_checker(RectangleShape{{1, 0, 1}, {0, 0, 10}, {10, 0, 0}}, 0.01);
    Transform& t = floor.objects[0].transform;
    t.axis = {0, 1, 0};
    t.degrees = 33;
    t.translation = {-8.2, 1.0 / 3, -1.6};
    expect_uniform(floor, kernel, 0.1F);
    std::get<RectangleShape>(floor.objects[0].shape).edge_u = {10, 0, 0};  // its back
    std::get<RectangleShape>(floor.objects[0].shape).edge_v = {0, 0, 10};
    expect_uniform(floor, kernel, 0.9F);
    // A large sphere that touches the plane: all of it lies below.
    Scene ball = shining_checker(SphereShape{{500, -1000, 500}, 1000, {0, 0, 0}}, 0.001);
    ball.objects[0].transform.translation = {-499.9, 0, -499.8};
    expect_uniform(ball, kernel, 0.1F);
  }
}

}  // namespace
}  // namespace lightbench
