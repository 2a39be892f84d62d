// Smooth glass: series of reflections between parallel faces, hollow balls, glass of index 1, and
// the edge of total reflection.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "app/stress/pictures.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

/// Every face of a plate reflects F: the wall is seen with (1 - F) / (1 + F).
KnownPicture plate(Random& random, Precision precision) {
  KnownPicture known;
  const double ior = random.chance(0.3) ? 1 + random.decade(-4, -1) : random.between(1.1, 2.5);
  const double degrees = random.between(0, 85), angle = degrees * kPi / 180;
  known.scene = wall_scene(4000, 16);
  add(known.scene, BoxShape{{-1000, -1000, -0.5}, {1000, 1000, 0.5}}, glass(ior));
  aim(known.scene, {2 * std::tan(angle), 0, 2}, dvec3(0));
  const auto passes = [&](double a) {
    const double f = fresnel(std::cos(std::clamp(a, 0.0, kPi / 2)), ior);
    return (1 - f) / (1 + f);
  };
  // The direction is good to the kernel's rounding, and so is 1 - sin^2 beyond the face.
  const double blur = 8 * rounding_of(precision) * (1 + std::tan(angle));
  known.low = std::min({passes(angle), passes(angle + blur), passes(angle - blur)});
  known.high = std::max({passes(angle), passes(angle + blur), passes(angle - blur)});
  known.what = fmt::format("plate of index {:.9g} at {:.9g} degrees", ior, degrees);
  return known;
}

/// Through the middle of n nested balls: 2 n faces at right angles, (1 - F) / (1 + (2 n - 1) F).
KnownPicture hollow(Random& random, Precision) {
  KnownPicture known;
  const double ior = random.between(1.1, 2.5), hole = random.decade(-3, -0.01);
  known.scene = wall_scene(4000, 16);
  add(known.scene, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, glass(ior));
  add(known.scene, SphereShape{{0, 0, 0}, hole, {0, 0, 0}}, glass(1 / ior));
  aim(known.scene, {0, 0, 5}, dvec3(0));
  const double f = fresnel(1, ior);
  known.low = known.high = (1 - f) / (1 + 3 * f);
  known.what = fmt::format("ball of index {:.9g} with a hole of radius {:.9g}", ior, hole);
  return known;
}

/// Glass in glass of the same index, and air in air, cannot be seen.
KnownPicture matched(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = wall_scene(4000, 16);
  const std::vector<PlacedShape> shapes = closed_shapes(s);
  const PlacedShape& shape = shapes[static_cast<std::size_t>(random.below(9))];
  const double ior = random.chance(0.5) ? 1 : random.between(1.1, 2.5);
  if (ior > 1) add(s, BoxShape{{-1000, -1000, -2}, {1000, 1000, 2}}, glass(ior));
  add(s, shape.shape, glass(1), shape.transform);
  aim(s, {random.between(-0.5, 0.5), random.between(-0.5, 0.5), 6}, {0.1, 0.05, 0});
  const dvec3 d = glm::normalize(s.camera.look_at - s.camera.look_from);
  const double f = fresnel(-d.z, ior);
  known.low = known.high = (1 - f) / (1 + f);
  known.what = fmt::format("{} of index 1 within index {:.9g}", shape.name, ior);
  return known;
}

/// From within glass towards a face, close to the critical angle: n^2 (1 - F) below it, nothing
/// beyond. What is reflected meets a black plate.
KnownPicture critical(Random& random, Precision precision) {
  KnownPicture known;
  const double ior = random.between(1.1, 2.5), edge = std::asin(1 / ior);
  const double off = random.decade(-12, -1), angle = random.chance(0.5) ? edge - off : edge + off;
  Scene& s = known.scene;
  s = dark_scene(16);
  add(s, BoxShape{{-1e3, -1e3, -1}, {1e3, 1e3, 1}}, glass(ior));
  add(s, RectangleShape{{-1e7, -1e7, -3}, {2e7, 0, 0}, {0, 2e7, 0}}, light(dvec3(1)));
  add(s, RectangleShape{{-1e3, -1e3, 0.5}, {2e3, 0, 0}, {0, 2e3, 0}}, black());
  // One ray exactly: the width of a pixel must not reach across the angle.
  look(s, dvec3(0), {std::sin(angle), 0, -std::cos(angle)}, 1e-15);
  const auto seen = [&](double a) { return ior * ior * (1 - fresnel(std::cos(a), 1 / ior)); };
  const double blur = 8 * rounding_of(precision);
  known.low = std::min(seen(angle + blur), seen(angle - blur));
  known.high = std::max(seen(angle + blur), seen(angle - blur));
  known.unit = ior * ior;
  known.what = fmt::format("from within index {:.17g}, {:.3g} {} the critical angle", ior, off,
                           angle < edge ? "below" : "beyond");
  return known;
}

KnownPicture draw_glass(Random& random, Precision precision) {
  switch (random.below(4)) {
    case 0:
      return plate(random, precision);
    case 1:
      return hollow(random, precision);
    case 2:
      return matched(random, precision);
    default:
      return critical(random, precision);
  }
}

}  // namespace

void add_glass_picture_tests(std::vector<Test>& tests) {
  add_known_pictures(tests, "glass",
                     "plates of index 1.0001 to 2.5 at 0 to 85 degrees, hollow balls, glass that "
                     "matches what is around it, and 10^U(-12,-1) on either side of the critical "
                     "angle",
                     10, 800, draw_glass);
}

}  // namespace lightbench::stress
