// Constant media: chords, white fog, a half space against Chandrasekhar's H function, and media
// that overlap with the camera inside.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "app/stress/pictures.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;

/// Along a chord of a ball or across a slab, from outside or from its middle.
KnownPicture chord(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = wall_scene(40, 16);
  const bool ball = random.chance(0.5), inside = random.chance(0.3);
  const double off = ball && !inside ? random.between(0, 0.95) : 0;
  const double length = (ball ? 2 * std::sqrt(1 - off * off) : 1.5) * (inside ? 0.5 : 1);
  const double depth = random.decade(-6, 2);  // optical
  if (ball) {
    add_medium(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, depth / length, dvec3(0));
  } else {
    add_medium(s, BoxShape{{-1, -1, -0.75}, {1, 1, 0.75}}, depth / length, dvec3(0));
  }
  aim(s, {off, 0, inside ? 0.0 : 5.0}, {off, 0, -1});
  known.low = known.high = std::exp(-depth);
  known.event = 1;
  known.what = fmt::format("{} of optical depth {:.4g}{}", ball ? "ball" : "slab", depth,
                           inside ? ", from within" : "");
  return known;
}

/// Lit through a slab: light sampling takes the transmittance itself, however thick.
KnownPicture shadow(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = dark_scene(16);
  const double depth = random.decade(-6, 0.5), distance = 300, radius = 0.3;
  add(s, RectangleShape{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, lambertian(dvec3(0.5)));
  add(s, SphereShape{{0, distance, 0}, radius, {0, 0, 0}},
      light(dvec3(distance * distance / (radius * radius) / 0.5)));
  add_medium(s, BoxShape{{-1, 1, -1}, {1, 2, 1}}, depth, dvec3(0));
  s.render.strategy = Strategy::Lights;
  aim(s, {-3, 0.3, 0}, dvec3(0));
  known.low = known.high = std::exp(-depth);
  known.what = fmt::format("lit through optical depth {:.4g}", depth);
  return known;
}

/// White fog in a white environment: 1 in every sample.
KnownPicture white(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = furnace_scene(1, 16);
  const std::vector<PlacedShape> shapes = closed_shapes(s);
  const PlacedShape& shape = shapes[static_cast<std::size_t>(random.below(9))];
  const double density = random.decade(-2, 1);
  add_medium(s, shape.shape, density, dvec3(1), shape.transform);
  const bool inside = random.chance(0.3);
  look(s, inside ? dvec3(0.05, 0.1, 0) : dvec3(0, 0, 5), {0, 0, -1}, 30);
  s.render.max_depth = s.render.roulette_depth = 10'000;
  known.low = known.high = 1;
  known.certain = true;
  known.what = fmt::format("white {} of density {:.4g}{}", shape.name, density,
                           inside ? ", from within" : "");
  return known;
}

/// H(mu) for isotropic scattering of this albedo (Chandrasekhar 1950, ch. V), by iterating
/// 1 / H(mu) = sqrt(1 - w) + w/2 integral of m H(m) / (mu + m) over m in [0,1].
double h_function(double mu, double albedo) {
  constexpr int kNodes = 400;
  const auto node = [](int i) { return (i + 0.5) / kNodes; };
  const auto inverse = [&](double x, const std::vector<double>& h) {
    double sum = 0;
    for (int i = 0; i < kNodes; ++i) {
      sum += node(i) * h[static_cast<std::size_t>(i)] / (x + node(i));
    }
    return std::sqrt(1 - albedo) + 0.5 * albedo * sum / kNodes;
  };
  std::vector<double> h(kNodes, 1), next(kNodes);
  for (int round = 0; round < 60; ++round) {
    for (int i = 0; i < kNodes; ++i) next[static_cast<std::size_t>(i)] = 1 / inverse(node(i), h);
    h = next;
  }
  return 1 / inverse(mu, h);
}

/// A half space under a white sky, seen at cosine mu: 1 - H(mu) sqrt(1 - w).
KnownPicture half_space(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = furnace_scene(1, 16);
  const double mu = random.between(0.1, 1), albedo = random.between(0.1, 0.95);
  // Deep and wide enough: light comes back from some tens of free paths.
  add_medium(s, BoxShape{{-500, -500, -1000}, {500, 500, 0}}, 1, dvec3(albedo));
  aim(s, {5 * std::sqrt(1 - mu * mu), 0, 5 * mu}, dvec3(0));
  known.low = known.high = 1 - h_function(mu, albedo) * std::sqrt(1 - albedo);
  known.unit = 1;
  known.what = fmt::format("half space of albedo {:.4g} at cosine {:.4g}", albedo, mu);
  return known;
}

/// Three media around the camera that overlap: their optical depths add up.
KnownPicture overlap(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = wall_scene(40, 16);
  const double a = random.decade(-3, 0), b = random.decade(-3, 0), c = random.decade(-3, 0);
  add_medium(s, SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, a, dvec3(0));
  add_medium(s, BoxShape{{-1, -1, -0.5}, {1, 1, 2}}, b, dvec3(0));
  add_medium(s, CylinderShape{{0, 0, -2}, {0, 0, 40}, 3}, c, dvec3(0));
  const double z = random.between(-0.4, 0.9);
  aim(s, {0, 0, z}, {0, 0, -2});
  known.low = known.high = std::exp(-a * (z + 1) - b * (z + 0.5) - c * (z + 2));
  known.event = 1;
  known.what = fmt::format("densities {:.4g} {:.4g} {:.4g} from z = {:.4g}", a, b, c, z);
  return known;
}

KnownPicture draw_medium(Random& random, Precision precision) {
  switch (random.below(5)) {
    case 0:
      return chord(random, precision);
    case 1:
      return shadow(random, precision);
    case 2:
      return white(random, precision);
    case 3:
      return half_space(random, precision);
    default:
      return overlap(random, precision);
  }
}

}  // namespace

void add_media_tests(std::vector<Test>& tests) {
  add_known_pictures(tests, "media",
                     "chords of optical depth 10^U(-6,2) by free flights and by light sampling, "
                     "white fog in nine shapes, half spaces of albedo .1 to .95 against "
                     "Chandrasekhar's H function, three overlapping media around the camera",
                     10, 2000, draw_medium);
}

}  // namespace lightbench::stress
