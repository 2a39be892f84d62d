// Surfaces that camera rays cannot meet: found, and no picture misses them.

#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE

#include "core/camera/in_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/compile/parts.h"
#include "core/scene/scene_io.h"
#include "tests/unit/changed_view.h"
#include "tests/unit/small_scenes.h"

LIGHTBENCH_KERNEL_BEGIN

/// Balls of radius 1 in a row from left to right, ahead of a camera that sees 6 by 6 units there.
Scene row_of_balls() {
  Scene scene;
  scene.camera.look_from = {0, 0, 10};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vfov = 33.398488;  // 2 atan(3 / 10)
  scene.render.width = scene.render.height = 60;
  scene.materials.resize(1);
  for (const double x : {-8.0, -2.0, 0.0, 2.0, 8.0}) {
    Object ball;
    ball.material = 0;
    ball.shape = SphereShape{{x, 0, 0}, 1, {}};
    scene.objects.push_back(ball);
  }
  return scene;
}

/// Numbers of the balls that the rays of a rectangle of film pixels may meet.
std::vector<int> seen(const Scene& scene, const Work& work) {
  const auto compiled = compile(scene, KernelKind::Reference);
  const auto& parts = std::get<KernelParts<T>>(compiled->parts->kernel);
  const Surfaces surfaces = surfaces_in_view(parts.view, work);
  std::vector<int> found;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (surfaces.among[parts.geometry->surface_of_object[i]] != 0)
      found.push_back(static_cast<int>(i));
  return found;
}

using Balls = std::vector<int>;

TEST(InView, IsWhatThePixelsLookAt) {
  EXPECT_EQ(seen(row_of_balls(), {0, 0, 60, 60}), (Balls{1, 2, 3}));
  EXPECT_EQ(seen(row_of_balls(), {0, 0, 16, 60}), (Balls{1}));
  EXPECT_EQ(seen(row_of_balls(), {26, 0, 34, 60}), (Balls{2}));
  EXPECT_EQ(seen(row_of_balls(), {0, 0, 60, 8}), Balls{}) << "above them";
  EXPECT_EQ(seen(row_of_balls(), {0, 43, 60, 60}), Balls{}) << "below them";
}

TEST(InView, ReachesAsFarAsTheFilter) {
  Scene scene = row_of_balls();
  const Work tile{0, 43, 60, 60};
  scene.render.filter = FilterKind::Gaussian;
  scene.render.filter_radius = 6;
  EXPECT_EQ(seen(scene, tile), (Balls{1, 2, 3}));
}

TEST(InView, KnowsCropsAndQuickLooks) {
  Scene scene = row_of_balls();
  scene.render.crop = {40, 0, 20, 60};
  EXPECT_EQ(seen(scene, {3, 0, 20, 60}), (Balls{3}));
  scene.render.crop = {};
  EXPECT_EQ(seen(scene, {11, 0, 15, 15, 0, 1, 4}), (Balls{3}));
}

TEST(InView, HoldsMovingBallsAllTheWay) {
  Scene scene = row_of_balls();
  scene.camera.shutter_close = 1;
  std::get<SphereShape>(scene.objects[0].shape).motion = {16, 0, 0};
  EXPECT_EQ(seen(scene, {26, 0, 34, 60}), (Balls{0, 2}));
}

TEST(InView, IsAllOfItThroughALens) {
  Scene scene = row_of_balls();
  scene.camera.lens_radius = 0.1;
  EXPECT_EQ(seen(scene, {0, 0, 60, 8}), (Balls{0, 1, 2, 3, 4}));
}

std::uint64_t film_in_tiles(const RenderScene& scene, int stride) {
  const int width = (scene.crop.width + stride - 1) / stride;
  const int height = (scene.crop.height + stride - 1) / stride;
  Film film(width, height, scene.film_unit);
  Counters counters;
  for (int y = 0; y < height; y += 4)
    for (int x = 0; x < width; x += 4)
      render(scene, {x, y, std::min(x + 4, width), std::min(y + 4, height), 0, 4, stride},
             film.view(), counters);
  return film.hash();
}

TEST(InView, ChangesNoBitOfAnyPicture) {
  int loops = 0;
  for (auto& [name, scene] : small_scenes(32, 24)) {
    for (const bool cropped : {false, true}) {
      if (cropped) scene.render.crop = {9, 5, 17, 13};
      for (const KernelKind kernel : {KernelKind::Auto, KernelKind::Reference}) {
        const auto compiled = compile(scene, kernel);
        const RenderScene other = with_changed_view(*compiled, [&loops](auto& view) {
          if (std::exchange(view.boxes, nullptr) != nullptr) ++loops;
        });
        for (const int stride : {1, 2})
          EXPECT_EQ(film_in_tiles(*compiled, stride), film_in_tiles(other, stride))
              << name << " in " << kernel_name(kernel) << ", stride " << stride
              << (cropped ? ", cropped" : "");
      }
    }
  }
  EXPECT_GE(loops, 20) << "few scenes without a tree";
}

LIGHTBENCH_KERNEL_END
