// Light samplers: samples against the density of their directions and against the light's surface,
// and random numbers at the ends of [0,1).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "app/stress/light_scenes.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

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

/// How far a sampled point is off the surface of the light, in units of half an ulp of (distance +
/// size).
double off_surface(const LightStage& stage, const glm::dvec3& from, const LightPoint& sample) {
  const Matrix to_world(stage.to_world), to_local = glm::inverse(to_world);
  const V p = V(from) + Number(sample.distance) * V(sample.direction);
  const V n = glm::transpose(glm::mat<3, 3, Number>(to_world)) * V(sample.normal);
  const V normal = glm::normalize(n);
  const Number off = off_face(stage.shape, V(to_local * glm::vec<4, Number>(p, 1)), normal);
  // A transform stretches heights over a surface by what it leaves of its normal.
  const Number left = glm::length(glm::transpose(glm::mat<3, 3, Number>(to_local)) * normal);
  return static_cast<double>(std::abs(off) / left) /
         (rounding_of(*stage.scene) * (sample.distance + 1));
}

enum ConsistencyLine { kConsistent, kEnds, kOnSurface, kMisses };

/// Rounding of the direction, 1000 sizes away some 1e-4 of the light's width, may carry a sample
/// near its outline across that.
constexpr double kRoundedOver = 1e-4;

/// What the longest chain of roundings on the way to a point may cost, a sphere's: the dot product
/// that gives the closest approach (3), that point (2), half the chord (3), their difference (1),
/// the length of the direction (2) and the light's own numbers (1).
constexpr double kOffSurface = 12;

void add_consistency(std::vector<Test>& tests, const LightKind& kind) {
  const std::string light = name_of(kind) + " light";
  std::vector<Line> lines{
      {light + ", pdf of a sample's direction", "|pdf / sample's pdf - 1|", 1e-6, 1e-3},
      {light + ", NaN, infinite, pdf <= 0 or not unit", "", kNoLimit, kNoLimit, 0},
      {light + ", samples on its surface", "distance from it in units", kOffSurface, kOffSurface}};
  if (kind.kind != Kind::Mesh) {
    lines.push_back({light + ", samples from outside that are invalid or miss", "", kNoLimit,
                     kNoLimit, kRoundedOver});
  }
  tests.push_back(
      {light + ", densities",
       "points outside at 10^U(-3,3) sizes, on the light and inside; a third of the random numbers "
       "from {0, 2^-53, 2^-32, 2^-24, .5, 1-2^-24, 1-2^-53}. Densities are compared where the "
       "direction meets the sampled point first, at cos .01 and up. A unit is half an ulp of "
       "(distance + size)",
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
             if (!sound) {
               tallies[kEnds].fail(text);
               continue;
             }
             tallies[kOnSurface].trial();
             tallies[kOnSurface].measure(off_surface(stage, queries[i].point, a), text);
             // The far side of a solid is met on the near one: another direction's business.
             const double cosine = std::abs(glm::dot(b.normal, b.direction));
             if (!b.valid || cosine < 0.01) continue;
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
  for (const LightKind& kind : kLightKinds) add_consistency(tests, kind);
}

}  // namespace lightbench::stress
