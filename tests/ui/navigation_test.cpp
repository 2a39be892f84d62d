#include "ui/navigation.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "core/query/rays.h"

namespace lightbench::ui {
namespace {

Camera camera_at(const glm::dvec3& from, const glm::dvec3& at) {
  Camera camera;
  camera.look_from = from;
  camera.look_at = at;
  return camera;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
  EXPECT_LT(glm::length(a - b), tolerance)
      << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

TEST(Navigation, OrbitKeepsTheDistanceAndTheTarget) {
  const Camera start = camera_at({3, 2, 5}, {1, 1, 0});
  const Camera turned = orbit(start, start.look_at, 40, -15);
  EXPECT_NEAR(glm::length(turned.look_from - turned.look_at),
              glm::length(start.look_from - start.look_at), 1e-9);
  expect_near(turned.look_at, start.look_at);
  EXPECT_GT(glm::length(turned.look_from - start.look_from), 0.5);
}

TEST(Navigation, OrbitByAQuarterTurn) {
  const Camera turned = orbit(camera_at({0, 0, 4}, {0, 0, 0}), {0, 0, 0}, 90, 0);
  expect_near(turned.look_from, {4, 0, 0});
}

TEST(Navigation, OrbitAboutAnotherPivotKeepsItInPlaceInThePicture) {
  const Camera start = camera_at({0, 1, 6}, {0, 1, 0});
  const glm::dvec3 pivot(1, 0.5, 2);
  const Camera turned = orbit(start, pivot, 25, 10);
  const auto before = project(start, {640, 480}, pivot);
  const auto after = project(turned, {640, 480}, pivot);
  ASSERT_TRUE(before && after);
  EXPECT_NEAR(before->x, after->x, 1e-6);
  EXPECT_NEAR(before->y, after->y, 1e-6);
}

TEST(Navigation, OrbitStopsBeforeThePole) {
  Camera camera = camera_at({0, 1, 5}, {0, 0, 0});
  for (int i = 0; i < 50; ++i) camera = orbit(camera, camera.look_at, 0, -20);
  const glm::dvec3 view = glm::normalize(camera.look_at - camera.look_from);
  EXPECT_LT(std::abs(view.y), 1 - 1e-5);
  EXPECT_GT(camera.look_from.y, 4.9);
}

TEST(Navigation, PanMovesThePointUnderTheMouseWithIt) {
  const Camera start = camera_at({0, 0, 10}, {0, 0, 0});
  const Camera moved = pan(start, {0.25, 0.1}, 10);
  const auto target = project(moved, {600, 400}, {0, 0, 0});
  ASSERT_TRUE(target);
  EXPECT_NEAR(target->x, 300 + 0.25 * 400, 1e-6);
  EXPECT_NEAR(target->y, 200 + 0.1 * 400, 1e-6);
}

TEST(Navigation, DollyScalesTheDistance) {
  const Camera start = camera_at({0, 0, 10}, {0, 0, 0});
  expect_near(dolly(start, {0, 0, 0}, 0.5).look_from, {0, 0, 5});
  expect_near(dolly(start, {0, 0, 0}, 2).look_from, {0, 0, 20});
}

TEST(Navigation, DollyNeverReachesTheTarget) {
  Camera camera = camera_at({0, 0, 10}, {0, 0, 0});
  for (int i = 0; i < 200; ++i) camera = dolly(camera, {0, 0, -3}, 0.8);
  EXPECT_GT(glm::length(camera.look_at - camera.look_from), 1e-3);
}

TEST(Navigation, LookTurnsOnTheSpot) {
  const Camera start = camera_at({1, 2, 3}, {1, 2, -3});
  const Camera turned = look(start, -90, 0);
  expect_near(turned.look_from, start.look_from);
  expect_near(glm::normalize(turned.look_at - turned.look_from), {1, 0, 0});
}

TEST(Navigation, FlyMovesAlongTheAxes) {
  const Camera moved = fly(camera_at({0, 0, 0}, {0, 0, -1}), {1, 2, 3});
  expect_near(moved.look_from, {1, 2, -3});
  expect_near(moved.look_at, {1, 2, -4});
}

TEST(Navigation, FrameBoundsPutsEveryCornerInThePicture) {
  Bounds box;
  box.add({-1, 4, 2});
  box.add({3, 5, 9});
  for (const double aspect : {0.5, 1.0, 2.5}) {
    const Camera framed = frame_bounds(camera_at({50, 60, 70}, {0, 0, 0}), box, aspect);
    const glm::dvec2 size(1000 * aspect, 1000);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x,
                         (corner & 2) != 0 ? box.max.y : box.min.y,
                         (corner & 4) != 0 ? box.max.z : box.min.z);
      const auto pixel = project(framed, size, p);
      ASSERT_TRUE(pixel);
      EXPECT_GE(pixel->x, 0);
      EXPECT_LE(pixel->x, size.x);
      EXPECT_GE(pixel->y, 0);
      EXPECT_LE(pixel->y, size.y);
    }
  }
}

TEST(Navigation, FrameBoundsOfNothingChangesNothing) {
  const Camera start = camera_at({1, 2, 3}, {0, 0, 0});
  EXPECT_EQ(frame_bounds(start, Bounds{}, 1), start);
}

TEST(Navigation, FocusIsMeasuredAlongTheViewAxis) {
  const Camera start = camera_at({0, 0, 10}, {0, 0, 0});
  EXPECT_NEAR(focus_on(start, {4, 3, 2}).focus_distance, 8, 1e-12);
  EXPECT_EQ(focus_on(start, {0, 0, 11}), start);
}

TEST(Navigation, ProjectAgreesWithTheCameraRay) {
  Scene scene;
  scene.camera = camera_at({3, 4, 5}, {-1, 0.5, 0});
  scene.render.width = 320;
  scene.render.height = 200;
  for (const glm::dvec2 pixel : {glm::dvec2(10, 20), glm::dvec2(160, 100), glm::dvec2(300, 190)}) {
    const Ray ray = camera_ray(scene, pixel.x, pixel.y);
    const auto back = project(scene.camera, {320, 200}, ray.origin + 7.0 * ray.direction);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->x, pixel.x, 1e-6);
    EXPECT_NEAR(back->y, pixel.y, 1e-6);
  }
}

}  // namespace
}  // namespace lightbench::ui
