// How noisy one sample of a light is: relative variance of the light that it brings to a receiver
// that faces it.

#include <fmt/format.h>

#include <glm/geometric.hpp>
#include <variant>

#include "app/stress/light_scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

constexpr int kGrid = 48;

/// Variance over squared mean of one sample, over a grid of random numbers, for each light of the
/// scene by itself; the mean is that of all. 0 if nothing arrives.
double relative_variance(const RenderScene& scene, const glm::dvec3& from, const glm::dvec3& n) {
  std::vector<LightQuery> queries;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      queries.push_back({from, (i + 0.5) / kGrid, (k + 0.5) / kGrid, 0, 0, 0});
    }
  }
  std::vector<LightPoint> points(queries.size());
  sample_lights(scene, queries, points);
  double sum = 0, squares = 0;
  for (const LightPoint& p : points) {
    const double cosine = p.valid ? glm::dot(p.direction, n) : 0;
    const double value = cosine > 0 ? p.radiance.x * cosine / p.pdf : 0;
    sum += value;
    squares += value * value;
  }
  const auto count = static_cast<double>(points.size());
  return sum > 0 ? squares * count / (sum * sum) - 1 : 0;
}

glm::dvec3 middle_of(const Shape& shape) {
  if (const auto* s = std::get_if<RectangleShape>(&shape)) {
    return s->corner + 0.5 * (s->edge_u + s->edge_v);
  }
  if (const auto* s = std::get_if<TriangleShape>(&shape)) return (s->a + s->b + s->c) / 3.0;
  if (const auto* s = std::get_if<PyramidShape>(&shape)) {
    return 0.25 * (s->vertices[0] + s->vertices[1] + s->vertices[2] + s->vertices[3]);
  }
  return glm::dvec3(0);  // all others are built around it
}

/// Any unit vector; of flat lights on the side of their normal n.
glm::dvec3 side_of(Random& random, const LightStage& stage, const glm::dvec3& n) {
  const glm::dvec3 d = random.direction();
  if (is_solid(stage.kind)) return d;
  // As many near their plane as over them.
  return random.chance(0.5) ? (glm::dot(d, n) < 0 ? -d : d)
                            : glm::normalize(random.across(n) + random.decade(-3, 0) * n);
}

void add(std::vector<Test>& tests, const LightKind& kind, double limit) {
  const std::string name = name_of(kind) + " light, variance of one sample";
  tests.push_back(
      {name,
       "receivers that face the light, 48 x 48 samples: 10^U(-3,3) sizes above a random point of "
       "it, "
       "or 10^U(.25,3) sizes from its middle in any direction, which for flat lights has a cosine "
       "above 1e-3",
       {{name, "variance / mean^2", limit, limit},
        {name + " from any side", "variance / mean^2", limit, limit}},
       256,
       5000,
       32,
       [kind](KernelKind kernel) -> Chunk {
         return [kernel, kind](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const LightStage stage = light_stage(random, kind, 1, kernel);
             const SurfacePoint s = random_surface_point(random, stage);
             const double height = random.decade(-3, 3);
             const auto judge = [&](Tally& tally, const glm::dvec3& from, const glm::dvec3& n) {
               const double variance = relative_variance(*stage.scene, from, n);
               tally.trial();
               tally.measure(variance, [&] {
                 return fmt::format("{:.3g} at {}, facing {}, from {}", variance, to_text(from),
                                    to_text(n), to_text(stage.shape));
               });
             };
             judge(tallies[0], s.p + height * s.n, -s.n);
             const glm::dvec3 side = side_of(random, stage, s.n);
             const glm::dvec3 middle = stage.in_world(middle_of(stage.shape));
             judge(tallies[1], middle + random.decade(0.25, 3) * side, -side);
           }
         };
       }});
}

}  // namespace

void add_light_variance_tests(std::vector<Test>& tests) {
  for (const LightKind& kind : kLightKinds) {
    if (kind.kind == Kind::Mesh) continue;  // its lights are triangles
    const bool exact =
        kind.kind == Kind::Sphere || kind.kind == Kind::Rectangle || kind.kind == Kind::Triangle;
    add(tests, kind, exact && !kind.stretched ? 0.35 : 0.5);
  }
}

}  // namespace lightbench::stress
