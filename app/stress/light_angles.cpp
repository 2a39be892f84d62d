// Light samplers: 1 / pdf, integrated over the random numbers, is the solid angle.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>

#include "app/stress/light_scenes.h"
#include "app/stress/quadrature.h"
#include "app/stress/scenes.h"
#include "app/stress/solid_angles.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

/// The points of the unit square at which 1 / pdf is taken, and their weights.
struct Rule {
  std::vector<std::array<double, 2>> u;
  std::vector<double> weight;

  void add(double x, double y, double w) {
    u.push_back({x, y});
    weight.push_back(w);
  }
};

/// Over both halves of the square and with both numbers squared, so that maps that fold it or take
/// square roots are smooth.
Rule folded_rule() {
  Rule rule;
  const auto nodes = gauss<20>();
  for (const auto& [s, ws] : nodes) {
    for (const auto& [c, wc] : nodes) {
      const double large = s * s, small = large * c * c, w = ws * wc * 4 * s * s * s * c;
      rule.add(large, small, w);
      rule.add(small, large, w);
    }
  }
  return rule;
}

/// Over the four quarters between the square's diagonals, where its map to the disk is smooth, by
/// distance from the middle and azimuth.
Rule disk_rule() {
  Rule rule;
  const auto around = gauss<24>();
  for (const auto& [r, wr] : gauss<12>()) {
    for (const auto& [s, ws] : around) {
      const double a = 0.5 * r, b = a * (2 * s - 1), w = 0.5 * r * wr * ws;
      rule.add(0.5 + a, 0.5 + b, w);
      rule.add(0.5 - a, 0.5 + b, w);
      rule.add(0.5 + b, 0.5 + a, w);
      rule.add(0.5 + b, 0.5 - a, w);
    }
  }
  return rule;
}

/// A cap up to u.x = `cap`, sampled by way of the disk, and a cylinder's side from there on, whose
/// density is linear in the azimuth by parts and has square roots at the outline.
Rule cylinder_rule(const Rule& disk, double cap) {
  constexpr int kSteps = 2048;
  Rule rule;
  for (std::size_t i = 0; cap > 0 && i < disk.u.size(); ++i) {
    rule.add(cap * disk.u[i][0], disk.u[i][1], cap * disk.weight[i]);
  }
  for (int i = 0; cap < 1 && i < kSteps; ++i) {
    const double s = (i + 0.5) / kSteps;
    const double x = s * s * (3 - 2 * s), w = 6 * s * (1 - s) / kSteps;
    for (const double y : {0.25, 0.75}) rule.add(cap + (1 - cap) * x, y, 0.5 * (1 - cap) * w);
  }
  return rule;
}

std::vector<LightPoint> samples_at(const RenderScene& scene, const glm::dvec3& from,
                                   std::span<const std::array<double, 2>> numbers) {
  std::vector<LightQuery> queries;
  for (const auto& [x, y] : numbers) queries.push_back({from, x, y, 0, 0, 0});
  std::vector<LightPoint> points(queries.size());
  sample_lights(scene, queries, points);
  return points;
}

/// Up to which u.x samples of a cylinder lie on its cap, whose normal is n.
double cap_share(const RenderScene& scene, const glm::dvec3& from, const glm::dvec3& n) {
  constexpr int kParts = 64;
  double low = 0, high = 1;  // the change is between them
  for (int level = 0; level < 5; ++level) {
    std::array<std::array<double, 2>, kParts> numbers;
    for (int i = 0; i < kParts; ++i) {
      numbers[static_cast<std::size_t>(i)] = {low + (high - low) * i / kParts, 0.5};
    }
    const std::vector<LightPoint> points = samples_at(scene, from, numbers);
    const auto on_side = std::find_if(points.begin(), points.end(), [&](const LightPoint& p) {
      return std::abs(glm::dot(p.normal, n)) < 0.999;
    });
    const auto caps = static_cast<double>(on_side - points.begin());
    const double step = (high - low) / kParts;
    if (caps == 0) return low;
    low += (caps - 1) * step;
    high = low + step;
  }
  return high;
}

/// The integral of 1 / pdf over the random numbers.
double sampled_angle(const RenderScene& scene, const glm::dvec3& from, const Rule& rule) {
  const std::vector<LightPoint> points = samples_at(scene, from, rule.u);
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].valid) sum += rule.weight[i] / points[i].pdf;
  }
  return sum;
}

/// The light as the kernel's numbers hold it: rounded corners and edges turn a flat one, or a face
/// of a flat solid, by some 1e-7, which shows where it is seen along its surface.
Shape held_shape(const RenderScene& scene, const Shape& shape) {
  if (const auto* t = std::get_if<TriangleShape>(&shape)) {
    return TriangleShape{as_held(scene, t->a), as_held(scene, t->b), as_held(scene, t->c)};
  }
  // Coordinates count from the middle of a scene of one object.
  if (const auto* r = std::get_if<RectangleShape>(&shape)) {
    const glm::dvec3 middle = r->corner + 0.5 * (r->edge_u + r->edge_v);
    return RectangleShape{as_held(scene, r->corner), as_held(scene, middle + r->edge_u) - middle,
                          as_held(scene, middle + r->edge_v) - middle};
  }
  if (const auto* s = std::get_if<PyramidShape>(&shape)) {
    const auto& v = s->vertices;
    const glm::dvec3 middle = 0.5 * (glm::min(glm::min(v[0], v[1]), glm::min(v[2], v[3])) +
                                     glm::max(glm::max(v[0], v[1]), glm::max(v[2], v[3])));
    PyramidShape held;
    held.vertices[0] = as_held(scene, v[0]);
    for (std::size_t i = 1; i < 4; ++i) {
      held.vertices[i] = held.vertices[0] + as_held(scene, middle + (v[i] - v[0])) - middle;
    }
    return held;
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

/// By the rule that suits the light's map of random numbers.
double sampled_angle_of(const LightStage& stage, const LightKind& kind, const glm::dvec3& from) {
  static const Rule kFolded = folded_rule(), kDisk = disk_rule();
  if (const auto* s = std::get_if<CylinderShape>(&stage.shape)) {
    const glm::dvec3 n = glm::normalize(glm::inverseTranspose(glm::dmat3(stage.to_world)) *
                                        glm::normalize(s->p1 - s->p0));
    return sampled_angle(*stage.scene, from,
                         cylinder_rule(kDisk, cap_share(*stage.scene, from, n)));
  }
  const bool round = kind.kind == Kind::Disc || kind.kind == Kind::Sphere;
  return sampled_angle(*stage.scene, from, round ? kDisk : kFolded);
}

void add_angle(std::vector<Test>& tests, const LightKind& kind) {
  constexpr double kLimit = 1e-6;
  const std::string name = name_of(kind) + " light, 1/pdf against its solid angle";
  const bool cylinder = kind.kind == Kind::Cylinder;
  // Cylinders' rules have many points, ellipsoids' integrals many steps.
  const bool costly = cylinder || (kind.kind == Kind::Sphere && kind.stretched);
  // Scaled by 1.2 at the most.
  const double nearest = kind.stretched ? 0.3 : 0.2;
  tests.push_back({name,
                   fmt::format("10^U({},7) sizes away, {}; 1/pdf integrated over u", nearest,
                               kind.flat ? "10^U(-5,1) out of the large faces' plane"
                                         : "seen at cos .05 and up"),
                   {{name, "relative error", kLimit, kLimit}},
                   cylinder ? 256U : 2048U,
                   costly ? 20'000U : 100'000U,
                   128,
                   [kind, nearest](KernelKind kernel) -> Chunk {
                     return [=](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
                       for (std::uint64_t i = 0; i < trials; ++i) {
                         const double away = random.decade(nearest, 7);
                         const LightStage stage = light_stage(random, kind, away, kernel);
                         const glm::dvec3 n = side_to_look_from(random, kind, stage);
                         const glm::dvec3 from = as_held(*stage.scene, away * n);
                         const Shape held = held_shape(*stage.scene, stage.shape);
                         const auto expected = static_cast<double>(
                             solid_angle(held, Matrix(stage.to_world), V(from)));
                         const double got = sampled_angle_of(stage, kind, from);
                         tallies[0].trial();
                         tallies[0].measure(std::abs(got / expected - 1), [&] {
                           return fmt::format("{} from {}: {:.17g} sr, not {:.17g}",
                                              to_text(stage.shape), to_text(from), got, expected);
                         });
                       }
                     };
                   }});
}

}  // namespace

void add_light_angle_tests(std::vector<Test>& tests) {
  for (const LightKind& kind : kLightKinds) {
    if (kind.kind != Kind::Mesh) add_angle(tests, kind);
  }
  add_angle(tests, {.kind = Kind::Box, .flat = true});
  add_angle(tests, {.kind = Kind::Pyramid, .flat = true});
}

}  // namespace lightbench::stress
