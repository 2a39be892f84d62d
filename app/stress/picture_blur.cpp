// What the shutter and the lens blur: shares of time and of a disc.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "app/stress/pictures.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;

/// A glowing ball passes the line of sight: it covers it while the distance between them is below
/// its radius. Alone, or among so many that they go into a tree.
KnownPicture draw_motion(Random& random, Precision precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = dark_scene(16);
  const double off = random.between(0, 0.95), speed = random.decade(0.5, 3);
  const double half = std::sqrt(1 - off * off) / speed;  // of the time that it covers
  const double middle = random.between(0, 1);
  double open = 0, close = 1;
  const int shutter = random.below(4);
  if (shutter == 1) {
    open = random.between(0, 0.5);
    close = random.between(0.5, 1);
  } else if (shutter > 1) {
    open = close = shutter - 2;  // an instant, time exactly 0 or 1
  }
  add(s, SphereShape{{-middle * speed, off, 0}, 1, {speed, 0, 0}}, light(dvec3(1)));
  const bool many = random.chance(0.5);
  if (many) {
    for (int i = 0; i < 100; ++i) {
      add(s,
          SphereShape{{random.between(-speed, speed), -3 - random.unit(), random.between(-4, 4)},
                      random.between(0.1, 0.5),
                      {random.between(-speed, speed), 0, random.between(-1, 1)}},
          lambertian(dvec3(0.5)));
    }
  }
  s.camera.shutter_open = open;
  s.camera.shutter_close = close;
  aim(s, {0, 0, 50}, dvec3(0));
  const auto share = [&](double h) {
    if (open == close) return std::abs(open - middle) < h ? 1.0 : 0.0;
    return std::max(0.0, std::min(close, middle + h) - std::max(open, middle - h)) / (close - open);
  };
  // The centre is good to the rounding of the largest coordinate.
  const double blur = 8 * rounding_of(precision) * (50 + speed) / speed;
  known.low = share(half - blur);
  known.high = share(half + blur);
  known.what = fmt::format(
      "ball at {:.4g} radii per unit of time, {:.4g} off, passing at {:.4g}, "
      "shutter {:.4g} to {:.4g}{}",
      speed, off, middle, open, close, many ? ", among 100" : "");
  return known;
}

/// A glowing half plane with its edge beside the axis: the pixel on the axis gathers the part of
/// the lens beyond a chord.
KnownPicture draw_lens(Random& random, Precision precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = dark_scene(16);
  constexpr double kWide = 20;
  const double lens = random.decade(-2, 0.3), focus = random.between(2, 8);
  const double depth =
      focus * (random.chance(0.5) ? random.between(0.2, 0.9) : random.between(1.1, 5));
  const double blurred = lens * std::abs(1 - depth / focus);  // radius of the lens at that depth
  const double share = random.between(-0.9, 0.9), edge = share * blurred;
  add(s, RectangleShape{{edge, -kWide, -depth}, {2 * kWide, 0, 0}, {0, 2 * kWide, 0}},
      light(dvec3(1)));
  // So narrow that what the pixels' shares differ by does not pass for noise.
  look(s, dvec3(0), {0, 0, -1}, std::min(1e-4, 0.01 * blurred / depth));
  s.camera.lens_radius = lens;
  s.camera.focus_distance = focus;
  // The edge is good to the rounding of the largest coordinate.
  const double off = 4 * rounding_of(precision) * 3 * kWide / blurred;
  known.low = disc_share_beyond(share + off);
  known.high = disc_share_beyond(share - off);
  known.what =
      fmt::format("lens of {:.4g} focused at {:.4g}, edge {:.4g} of its blur off at {:.4g}", lens,
                  focus, share, depth);
  return known;
}

}  // namespace

void add_blur_tests(std::vector<Test>& tests) {
  add_known_pictures(tests, "motion blur",
                     "a ball at 3 to 1000 radii per shutter, alone or among 100 moving ones; the "
                     "whole shutter, a part of it, time exactly 0 or 1",
                     10, 4000, draw_motion);
  add_known_pictures(tests, "thin lens",
                     "an edge out of focus before and behind, lens of radius 10^U(-2,.3)", 8, 4000,
                     draw_lens);
}

}  // namespace lightbench::stress
