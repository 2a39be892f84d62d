// What the lens and the shutter blur, as shares of a disc and of time.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec3;

class CameraBlur : public testing::TestWithParam<KernelUnderTest> {
 protected:
  CameraBlur() : family(GetParam().family()) {}
  void check(const std::string& name, double expected, const Scene& scene, int spp = 512) {
    family.add(name, expected, measure_uniform(scene, GetParam().kind, GetParam().spp(spp)));
  }
  Family family;
};

// A glowing ball passes the line of sight: it covers it while the distance between them is below
// its radius.
TEST_P(CameraBlur, MotionCoversAShareOfTheShutter) {
  const double radius = 1, off = 0.6,
               speed = 8;  // moves along x from -4 to 4, `off` above the line
  const double half = std::sqrt(radius * radius - off * off) / speed;  // around time 0.5
  for (const auto& [open, close] : {std::pair{0.0, 1.0}, {0.25, 0.5}, {0.45, 0.55}, {0.5, 0.9}}) {
    for (const bool stretched : {false, true}) {
      Scene s = dark_scene();
      // The stretched one is an ellipsoid of the same outline at the line of sight.
      add(s, SphereShape{{-4, off, 0}, radius, {speed, 0, 0}}, light(dvec3(1)),
          stretched ? scaled({1, 1, 0.3}) : Transform{});
      s.camera.shutter_open = open;
      s.camera.shutter_close = close;
      aim(s, {0, 0, 50}, dvec3(0));
      const double share =
          std::max(0.0, std::min(close, 0.5 + half) - std::max(open, 0.5 - half)) / (close - open);
      check("shutter " + std::to_string(open) + " to " + std::to_string(close) +
                (stretched ? ", ellipsoid" : ""),
            share, s);
    }
  }
  for (const auto& [time, seen] : {std::pair{0.3, 0.0}, {0.5, 1.0}}) {
    Scene s = dark_scene();
    add(s, SphereShape{{-4, off, 0}, radius, {speed, 0, 0}}, light(dvec3(1)));
    s.camera.shutter_open = s.camera.shutter_close = time;
    aim(s, {0, 0, 50}, dvec3(0));
    EXPECT_EQ(measure_uniform(s, GetParam().kind, 8).mean.y, seen) << "an instant at " << time;
  }
  family.expect_agreement();
}

// Motion among many objects goes through the tree and its moving boxes.
TEST_P(CameraBlur, MotionAmongManyObjects) {
  const double radius = 1, off = 0.6, speed = 8;
  Scene s = dark_scene();
  add(s, SphereShape{{-4, off, 0}, radius, {speed, 0, 0}}, light(dvec3(1)));
  for (int i = 0; i < 200; ++i) {
    add(s, SphereShape{{0.3 * (i % 20) - 3, -3 - 0.3 * (i / 20), -0.1 * i}, 0.1, {0.2, 0, 0}},
        lambertian(dvec3(0.5)));
  }
  aim(s, {0, 0, 50}, dvec3(0));
  check("ball among 200", 2 * std::sqrt(radius * radius - off * off) / speed, s);
  family.expect_agreement();
}

// A glowing half plane with its edge e beside the axis at depth D, lens of radius A focused at F:
// the pixel on the axis gathers the part of the lens beyond a chord.
TEST_P(CameraBlur, LensSeesTheShareOfADiscBeyondAnEdge) {
  const double lens = 0.5, focus = 4;
  for (const double depth : {2.0, 3.0, 8.0, 40.0}) {
    for (const double edge : {0.05, -0.1, 0.2}) {
      Scene s = dark_scene();
      add(s, RectangleShape{{edge, -1000, -depth}, {2000, 0, 0}, {0, 2000, 0}}, light(dvec3(1)));
      aim(s, dvec3(0), {0, 0, -1});
      s.camera.lens_radius = lens;
      s.camera.focus_distance = focus;
      // A lens point x meets the depth at x (1 - D/F).
      check("depth " + std::to_string(depth) + " edge " + std::to_string(edge),
            disc_share_beyond(edge / (lens * std::abs(1 - depth / focus))), s, 1024);
    }
  }
  for (const double edge : {-1e-3, 1e-3}) {
    Scene s = dark_scene();
    add(s, RectangleShape{{edge, -100, -focus}, {200, 0, 0}, {0, 200, 0}}, light(dvec3(1)));
    aim(s, dvec3(0), {0, 0, -1});
    s.camera.lens_radius = lens;
    s.camera.focus_distance = focus;
    EXPECT_EQ(measure_uniform(s, GetParam().kind, 8).mean.y, edge < 0 ? 1 : 0) << "in focus";
  }
  family.expect_agreement();
}

// A small glowing disc on the axis, out of focus: the pixel on the axis sees it through that part
// of the lens whose rays meet it, a smaller disc.
TEST_P(CameraBlur, LensSeesASmallDiscByItsAreaShare) {
  const double lens = 0.5, focus = 4, depth = 8, radius = 0.2;
  Scene s = dark_scene();
  add(s, DiscShape{{0, 0, -depth}, {0, 0, 1}, radius}, light(dvec3(1)));
  aim(s, dvec3(0), {0, 0, -1});
  s.camera.lens_radius = lens;
  s.camera.focus_distance = focus;
  const double share = radius / (lens * std::abs(1 - depth / focus));
  check("disc", share * share, s, 2048);
  family.expect_agreement();
}

// The whole picture of a wall's edge, per filter: the mean must not depend on how a pixel gathers.
TEST_P(CameraBlur, FiltersKeepTheMeanOfASmoothPicture) {
  for (const FilterKind filter : {FilterKind::Box, FilterKind::Triangle, FilterKind::Gaussian}) {
    Scene s = dark_scene();
    s.environment = {EnvironmentKind::Gradient, dvec3(1), dvec3(0), 1, 0, "", nullptr};
    s.render.filter = filter;
    s.render.filter_radius = 1.5;
    look(s, dvec3(0), {1, 0, 0}, 60);
    s.camera.up = dvec3(0, 1, 0);
    // Above and below the horizon cancel: the lerp's middle.
    family.add("filter " + std::to_string(static_cast<int>(filter)), 0.5,
               measure_by_seeds(s, GetParam().kind, GetParam().spp(16), 16));
  }
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, CameraBlur, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
