// Camera rays of the kernel: field of view, lens, shutter.

#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE

#include "core/camera/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/compile/parts.h"
#include "core/compile/render_scene.h"
#include "core/query/rays.h"

LIGHTBENCH_KERNEL_BEGIN

using glm::dvec3;

Scene view_scene() {
  Scene scene;
  scene.camera.look_from = {3, 2, 7};
  scene.camera.look_at = {1, -1, 0.5};
  scene.camera.up = {0.1, 1, 0.2};
  scene.camera.vfov = 35;
  scene.camera.focus_distance = 5;
  scene.render.width = 300;
  scene.render.height = 200;
  scene.materials.resize(1);
  Object ball;
  ball.material = 0;
  scene.objects = {ball};
  return scene;
}

/// The compiled camera, which must outlive its scene.
struct Compiled {
  std::shared_ptr<const RenderScene> scene;
  const KernelParts<T>* parts;
  explicit Compiled(const Scene& s)
      : scene(compile(s, KernelKind::Reference)),
        parts(&std::get<KernelParts<T>>(scene->parts->kernel)) {}
  /// In scene units.
  [[nodiscard]] dvec3 origin(const test_reference::Ray& r) const {
    return parts->geometry->space.to_scene({r.o.x, r.o.y, r.o.z});
  }
  [[nodiscard]] test_reference::Ray ray(double x, double y, std::uint32_t sample = 0) const {
    return test_reference::camera_ray(parts->view, x, y, Sampler{hash(17U), reverse_bits(sample)});
  }
};
dvec3 direction(const test_reference::Ray& r) { return {r.d.x, r.d.y, r.d.z}; }
double angle(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(CameraRays, SpanTheFieldOfView) {
  const Scene scene = view_scene();
  const Compiled c(scene);
  const dvec3 forward = glm::normalize(scene.camera.look_at - scene.camera.look_from);
  EXPECT_NEAR(angle(direction(c.ray(150, 100)), forward), 0, 1e-12);
  const double vfov = 35 * std::numbers::pi / 180;
  EXPECT_NEAR(angle(direction(c.ray(150, 0)), direction(c.ray(150, 200))), vfov, 1e-12);
  const double hfov = 2 * std::atan(1.5 * std::tan(0.5 * vfov));
  EXPECT_NEAR(angle(direction(c.ray(0, 100)), direction(c.ray(300, 100))), hfov, 1e-12);
  // y runs down and x to the right of an upright viewer.
  EXPECT_GT(glm::dot(direction(c.ray(150, 0)), scene.camera.up),
            glm::dot(direction(c.ray(150, 200)), scene.camera.up));
  const dvec3 right = glm::cross(forward, scene.camera.up);
  EXPECT_GT(glm::dot(direction(c.ray(300, 100)), right), 0);
  EXPECT_NEAR(glm::dot(direction(c.ray(150, 0)), right), 0, 1e-12);
  for (const double x : {0.0, 150.0, 300.0})
    EXPECT_NEAR(glm::length(c.origin(c.ray(x, 30)) - scene.camera.look_from), 0, 1e-12);
}

TEST(CameraRays, AreThoseOfThePublicCamera) {
  const Scene scene = view_scene();
  const Compiled c(scene);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {300.0, 0.0}, {12.5, 187.25}, {150.0, 100.0}}) {
    const lightbench::Ray expected = lightbench::camera_ray(scene, x, y);
    EXPECT_NEAR(glm::length(direction(c.ray(x, y)) - expected.direction), 0, 1e-12);
    EXPECT_NEAR(glm::length(c.origin(c.ray(x, y)) - expected.origin), 0, 1e-12);
  }
}

TEST(CameraRays, ThroughALensMeetInTheFocusPlane) {
  Scene scene = view_scene();
  scene.camera.lens_radius = 0.4;
  const Compiled c(scene);
  const dvec3 forward = glm::normalize(scene.camera.look_at - scene.camera.look_from);
  constexpr std::uint32_t kSamples = 4096;
  std::vector<double> observed(64);
  for (const auto& [x, y] : {std::pair{150.0, 100.0}, {20.0, 180.0}}) {
    const dvec3 pinhole = lightbench::camera_ray(scene, x, y).direction;
    const dvec3 focus = scene.camera.look_from +
                        pinhole * (scene.camera.focus_distance / glm::dot(pinhole, forward));
    std::fill(observed.begin(), observed.end(), 0.0);
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const auto ray = c.ray(x, y, i);
      const dvec3 o = c.origin(ray), offset = o - scene.camera.look_from;
      EXPECT_NEAR(angle(focus - o, direction(ray)), 0, 1e-7);
      EXPECT_NEAR(glm::dot(offset, forward), 0, 1e-12);
      const double share = glm::dot(offset, offset) / (0.4 * 0.4);
      ASSERT_LE(share, 1 + 1e-12);
      const dvec3 right = glm::normalize(glm::cross(forward, scene.camera.up));
      const double turn =
          std::atan2(glm::dot(offset, glm::cross(right, forward)), glm::dot(offset, right)) /
              (2 * std::numbers::pi) +
          0.5;
      observed[static_cast<std::size_t>(std::min(share * 8, 7.9)) * 8 +
               static_cast<std::size_t>(std::min(turn * 8, 7.9))] += 1;
    }
    for (const double n : observed)
      EXPECT_NEAR(n, kSamples / 64.0, 40) << "the lens is not evenly lit";
  }
}

TEST(CameraRays, CoverTheShutterOnlyIfSomethingMoves) {
  Scene scene = view_scene();
  EXPECT_EQ(Compiled(scene).ray(3, 4, 5).time, 0);
  std::get<SphereShape>(scene.objects[0].shape).motion = {1, 0, 0};
  scene.camera.shutter_open = 0.25;
  scene.camera.shutter_close = 0.75;
  const Compiled c(scene);
  std::vector<int> count(16);
  for (std::uint32_t i = 0; i < 1024; ++i) {
    const double time = c.ray(3, 4, i).time;
    ASSERT_TRUE(time >= 0 && time < 1);
    ++count[static_cast<std::size_t>(time * 16)];
  }
  for (const int n : count) EXPECT_EQ(n, 64) << "a stratified sequence fills sixteenths evenly";
  // A moving sphere is found where it is at the ray's time, in the scene's own clock.
  for (const double time : {0.25, 0.5, 0.75}) {
    lightbench::Ray ray;
    ray.origin = {time, 0, 5};
    ray.time = time;
    const auto hit = trace(*c.scene, ray);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 4, 1e-12);
  }
}

LIGHTBENCH_KERNEL_END
