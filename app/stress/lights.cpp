// Light samplers: densities against solid angles, samples against the density of their directions,
// and random numbers at the ends of [0,1).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/stress/light_scenes.h"
#include "app/stress/scenes.h"
#include "app/stress/solid_angles.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

// ---- solid angles
// --------------------------------------------------------------------------------

/// Nodes and weights of Gauss and Legendre on [0,1], by Newton's iteration.
template <std::size_t kCount>
std::array<std::pair<double, double>, kCount> gauss() {
  std::array<std::pair<double, double>, kCount> rule;
  for (std::size_t i = 0; i < kCount; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (kCount + 0.5));
    double slope = 1;
    for (int step = 0; step < 60; ++step) {
      double p0 = 1, p1 = x;
      for (std::size_t k = 2; k <= kCount; ++k) {
        const auto n = static_cast<double>(k);
        const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = static_cast<double>(kCount) * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    rule[i] = {0.5 * (x + 1), 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

/// The points of the unit square at which 1 / pdf is taken, and their weights.
struct Rule {
  std::vector<std::array<double, 2>> u;
  std::vector<double> weight;
};

/// Over both halves of the square and with both numbers squared, so that maps that fold it or take
/// square roots are smooth.
Rule folded_rule() {
  Rule rule;
  const auto nodes = gauss<20>();
  for (const auto& [s, ws] : nodes) {
    for (const auto& [c, wc] : nodes) {
      const double large = s * s, small = large * c * c;
      rule.u.push_back({large, small});
      rule.u.push_back({small, large});
      rule.weight.insert(rule.weight.end(), 2, ws * wc * 4 * s * s * s * c);
    }
  }
  return rule;
}

/// For densities with a step somewhere along u.x, from one part of the light to another.
Rule stepped_rule() {
  constexpr int kSteps = 1024;
  Rule rule;
  for (int i = 0; i < kSteps; ++i) {
    for (const auto& [y, w] : gauss<6>()) {
      rule.u.push_back({(i + 0.5) / kSteps, y});
      rule.weight.push_back(w / kSteps);
    }
  }
  return rule;
}

/// The integral of 1 / pdf over the random numbers, which is the solid angle.
double sampled_angle(const RenderScene& scene, const glm::dvec3& from, const Rule& rule) {
  std::vector<LightQuery> queries;
  for (const auto& [x, y] : rule.u) queries.push_back({from, x, y, 0, 0, 0});
  std::vector<LightPoint> points(queries.size());
  sample_lights(scene, queries, points);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].valid) sum += rule.weight[i] / points[i].pdf;
  }
  return sum;
}

/// The light as the kernel's numbers hold it: rounded corners and edges turn a flat one by some
/// 1e-7, which shows where it is seen along its surface.
Shape held_shape(const RenderScene& scene, const Shape& shape) {
  if (const auto* t = std::get_if<TriangleShape>(&shape)) {
    return TriangleShape{as_held(scene, t->a), as_held(scene, t->b), as_held(scene, t->c)};
  }
  if (const auto* r = std::get_if<RectangleShape>(&shape)) {
    // The middle of a scene of one object, from which coordinates count.
    const glm::dvec3 middle = r->corner + 0.5 * (r->edge_u + r->edge_v);
    return RectangleShape{as_held(scene, r->corner), as_held(scene, middle + r->edge_u) - middle,
                          as_held(scene, middle + r->edge_v) - middle};
  }
  return shape;
}

/// From where to look, unit: anywhere, at flat lights not along them; at flat solids mostly along
/// their large faces.
glm::dvec3 side_to_look_from(Random& random, const LightKind& kind, const LightStage& stage) {
  if (kind.flat) {
    glm::dvec3 n;
    if (const auto* s = std::get_if<BoxShape>(&stage.shape)) {
      for (int k = 0; k < 3; ++k) n[k] = s->max[k] < 0.01 ? 1 : 0;
    } else {
      const auto& v = std::get<PyramidShape>(stage.shape).vertices;
      n = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
    }
    const double tilt = random.decade(-5, 1);
    return glm::normalize(random.across(n) + (random.chance(0.5) ? tilt : -tilt) * n);
  }
  glm::dvec3 n = random.direction();
  if (!is_solid(kind.kind)) {
    const glm::dvec3 face(random_surface_point(random, stage).n);
    while (std::abs(glm::dot(n, face)) < 0.05) n = random.direction();
  }
  return n;
}

void add_angle(std::vector<Test>& tests, const LightKind& kind, double limit, double limit_auto) {
  const std::string name = name_of(kind) + " light, 1/pdf against its solid angle";
  const bool stepped = kind.kind == Kind::Cylinder;
  tests.push_back(
      {name,
       kind.flat ? "10^U(.2,7) sizes away, 10^U(-5,1) out of the large faces' plane; 1/pdf "
                   "integrated over u"
                 : "10^U(.2,7) sizes away, seen at cos .05 and up; 1/pdf integrated over u",
       {{name, "relative error", limit, limit_auto}},
       stepped ? 256U : 2048U,
       stepped ? 10'000U : 1'000'000U,
       128,
       [kind, stepped](KernelKind kernel) -> Chunk {
         const Rule rule = stepped ? stepped_rule() : folded_rule();
         return
             [kernel, kind, rule](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
               for (std::uint64_t i = 0; i < trials; ++i) {
                 const double away = random.decade(0.2, 7);
                 const LightStage stage = light_stage(random, kind, away, kernel);
                 const glm::dvec3 n = side_to_look_from(random, kind, stage);
                 const glm::dvec3 from = as_held(*stage.scene, away * n);
                 const Shape held = held_shape(*stage.scene, stage.shape);
                 const auto expected = static_cast<double>(solid_angle(held, V(from)));
                 const double got = sampled_angle(*stage.scene, from, rule);
                 tallies[0].trial();
                 tallies[0].measure(std::abs(got / expected - 1), [&] {
                   return fmt::format("{} from {}: {:.17g} sr, not {:.17g}", to_text(stage.shape),
                                      to_text(from), got, expected);
                 });
               }
             };
       }});
}

// ---- density of samples
// --------------------------------------------------------------------------

/// Outside at 10^U(-3,3) sizes, on the surface, or inside.
struct Receiver {
  glm::dvec3 p{0};
  bool outside = false;
};
Receiver receiver(Random& random, const LightStage& stage) {
  const SurfacePoint s = random_surface_point(random, stage);
  switch (random.below(3)) {
    case 0:
      return {is_solid(stage.kind) ? stage.in_world(random_point(random, stage.shape)) : s.p};
    case 1:
      return {s.p};
    default:
      return {s.p + random.decade(-3, 3) * glm::normalize(s.n + 0.9 * random.direction()), true};
  }
}

enum ConsistencyLine { kConsistent, kEnds, kMisses };

/// Rounding of the direction, 1000 sizes away some 1e-4 of the light's width, may carry a sample
/// near its outline across that.
constexpr double kRoundedOver = 1e-4;

void add_consistency(std::vector<Test>& tests, const LightKind& kind) {
  const std::string light = name_of(kind) + " light";
  std::vector<Line> lines{
      {light + ", pdf of a sample's direction", "|pdf / sample's pdf - 1|", 1e-6, 1e-3},
      {light + ", NaN, infinite, pdf <= 0 or not unit", "", kNoLimit, kNoLimit, 0}};
  if (kind.kind != Kind::Mesh) {
    lines.push_back({light + ", samples from outside that are invalid or miss", "", kNoLimit,
                     kNoLimit, kRoundedOver});
  }
  tests.push_back(
      {light + ", densities",
       "points outside at 10^U(-3,3) sizes, on the light and inside; a third of the random numbers "
       "from {0, 2^-53, 2^-32, 2^-24, .5, 1-2^-24, 1-2^-53}. Densities are compared where the "
       "direction meets the sampled point first, at cos .01 and up",
       lines, 60'000, 10'000'000, 4096, [kind](KernelKind kernel) -> Chunk {
         return [kernel, kind](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           constexpr double kEdges[] = {0,   0x1p-53,     0x1p-32,    0x1p-24,
                                        0.5, 1 - 0x1p-24, 1 - 0x1p-53};
           const LightStage stage = light_stage(random, kind, 1, kernel);
           const int lights = light_count(*stage.scene);
           std::vector<LightQuery> queries(trials);
           std::vector<bool> outside(trials);
           for (std::size_t i = 0; i < trials; ++i) {
             LightQuery& q = queries[i];
             const auto number = [&] {
               return random.chance(0.33) ? kEdges[random.below(std::size(kEdges))] : random.unit();
             };
             const Receiver r = receiver(random, stage);
             q.point = as_held(*stage.scene, r.p);
             q.u = number();
             q.v = number();
             q.light = random.below(lights);
             // The ends of the random numbers lie on the outline itself. Of a mesh's triangles some
             // are seen edge on, so their samples are not counted.
             outside[i] = r.outside && kind.kind != Kind::Mesh && std::min(q.u, q.v) > 0.01 &&
                          std::max(q.u, q.v) < 0.99;
           }
           std::vector<LightPoint> samples(trials), seen(trials);
           sample_lights(*stage.scene, queries, samples);
           std::vector<LightDirection> directions(trials);
           for (std::size_t i = 0; i < trials; ++i) {
             const bool usable = samples[i].valid && glm::length(samples[i].direction) > 0.5;
             directions[i] = {queries[i].point, usable ? samples[i].direction : glm::dvec3(0, 0, 1),
                              queries[i].light, 0};
           }
           pdf_lights(*stage.scene, directions, seen);
           for (std::size_t i = 0; i < trials; ++i) {
             const LightPoint &a = samples[i], &b = seen[i];
             const auto text = [&] {
               return fmt::format(
                   "{} from {}, light {}, u {:.17g} {:.17g}: pdf {:.9g}, of its "
                   "direction {:.9g}, distance {:.9g} and {:.9g}",
                   to_text(stage.shape), to_text(queries[i].point), queries[i].light, queries[i].u,
                   queries[i].v, a.pdf, b.pdf, a.distance, b.distance);
             };
             tallies[kEnds].trial();
             if (outside[i]) {
               tallies[kMisses].trial();
               if (!a.valid || !b.valid) tallies[kMisses].fail(text);
             }
             if (!a.valid) continue;
             const bool sound = a.pdf > 0 && std::isfinite(a.pdf) && std::isfinite(a.distance) &&
                                std::abs(glm::length(a.direction) - 1) < 1e-6;
             if (!sound) tallies[kEnds].fail(text);
             // The far side of a solid is met on the near one: another direction's business.
             const double cosine = std::abs(glm::dot(b.normal, b.direction));
             if (!sound || !b.valid || cosine < 0.01) continue;
             const double rounding = 64 * rounding_of(*stage.scene) * (1 + b.distance) / cosine;
             // Nor are the faces that meet in an edge the same place.
             const bool same_face = glm::dot(a.normal, b.normal) > 0.9999;
             if (!same_face || std::abs(a.distance - b.distance) > rounding) continue;
             tallies[kConsistent].trial();
             tallies[kConsistent].measure(std::abs(b.pdf / a.pdf - 1), text);
           }
         };
       }});
}

}  // namespace

void add_light_tests(std::vector<Test>& tests) {
  for (const Kind kind :
       {Kind::Sphere, Kind::Pyramid, Kind::Box, Kind::Rectangle, Kind::Triangle}) {
    add_angle(tests, {kind}, 1e-6, 1e-6);
  }
  add_angle(tests, {.kind = Kind::Box, .flat = true}, 1e-6, 1e-6);
  // Slivers of slivers: float is not as exact along their faces.
  add_angle(tests, {.kind = Kind::Pyramid, .flat = true}, 1e-6, 1e-5);
  // Their densities vary a little, and so the rule over u is less exact.
  for (const Kind kind : {Kind::Disc, Kind::Cylinder}) add_angle(tests, {kind}, 1e-3, 1e-3);
  for (const LightKind& kind : kLightKinds) add_consistency(tests, kind);
}

}  // namespace lightbench::stress
