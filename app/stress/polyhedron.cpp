// Boxes and pyramids: thin ones, grazing and far, against long double.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerShape = 128;
constexpr double kScore = 8;

/// A solid with its corners; about unit size.
struct Target {
  Shape shape;
  std::vector<glm::dvec3> corners;
};

Target random_box(Random& random) {
  glm::dvec3 half(0.5);
  half[random.below(3)] *= random.decade(-4, 0);
  const glm::dvec3 middle = random.in_cube(2);
  const BoxShape s{middle - half, middle + half};
  Target target{s, {}};
  for (unsigned k = 0; k < 8; ++k) {
    target.corners.push_back({(k & 1U) != 0 ? s.max.x : s.min.x, (k & 2U) != 0 ? s.max.y : s.min.y,
                              (k & 4U) != 0 ? s.max.z : s.min.z});
  }
  return target;
}

Target random_pyramid(Random& random) {
  const glm::dvec3 n = random.direction(), u = random.across(n), v = glm::cross(n, u);
  const glm::dvec3 middle = random.in_cube(2);
  PyramidShape s;
  for (int k = 0; k < 3; ++k) {
    const double a = 2.0943951023931953 * (k + random.between(-0.2, 0.2));
    s.vertices[static_cast<std::size_t>(k)] = middle + 0.6 * (std::cos(a) * u + std::sin(a) * v);
  }
  s.vertices[3] = middle + random.decade(-4, 0) * n + 0.2 * random.between(-1, 1) * u;
  return {s, {s.vertices.begin(), s.vertices.end()}};
}

glm::dvec3 aim(Random& random, const Target& target) {
  const int count = static_cast<int>(target.corners.size());
  const auto corner = [&] { return target.corners[static_cast<std::size_t>(random.below(count))]; };
  const glm::dvec3 a = corner(), b = corner(), c = corner();
  const double x = random.unit(), y = random.unit() * (1 - x);
  // A face or the inside, an edge or a diagonal, a corner; exactly or nearly.
  const int what = random.below(3);
  glm::dvec3 p = what == 0 ? a : (what == 1 ? a + x * (b - a) : a + x * (b - a) + y * (c - a));
  if (random.chance(0.5)) p += random.in_cube(random.decade(-9, -1));
  return p;
}

enum PolyhedronLine { kScored, kWrong };

void judge(const RenderScene& scene, const Target& target, const Ray& ray,
           const std::optional<Hit>& hit, std::span<Tally> tallies) {
  const OracleRay exact = exact_ray(scene, ray);
  const Span span = solid_span(target.shape, exact);
  const Number size = glm::length(V(ray.origin - target.corners[0])) + 1;
  const Number unit = rounding_of(scene) * size;
  const Span inner = solid_span(target.shape, exact, -kScore * unit);
  const Span outer = solid_span(target.shape, exact, kScore * unit);
  const auto text = [&] { return to_text(target.shape) + " " + to_text(ray); };
  if (inner.hit || !outer.hit) {
    tallies[kWrong].trial();
    if (hit.has_value() != inner.hit) {
      tallies[kWrong].fail([&] { return (inner.hit ? "missed: " : "hit: ") + text(); });
    }
  }
  if (!hit || !inner.hit) return;
  const V p = exact_position(*hit), right = exact.o + span.near * exact.d;
  // An error along the ray is the error of a face over its cosine; beside an edge, of the steeper.
  const Number cosine = std::min(std::abs(glm::dot(solid_normal(target.shape, right), exact.d)),
                                 std::abs(glm::dot(V(hit->geometric_normal), exact.d)));
  const Number along = std::abs(told_distance(ray, *hit) - span.near) * cosine;
  const Number off = std::abs(outside_of(target.shape, p));
  tallies[kScored].trial();
  tallies[kScored].measure(static_cast<double>(std::max(along / unit, off / rounding_of(scene))),
                           text);
}

void add(std::vector<Test>& tests, const std::string& name, Target (*random_target)(Random&)) {
  tests.push_back(
      {name,
       "one extent 10^U(-4,0), distance/size 10^U(0,7), half of the rays within 10^U(-6,-2) of the "
       "plane of a face; aimed at corners, edges, faces and past them; no verdict on hit or miss "
       "within 8 units of the outline. A unit is half an ulp of distance + size",
       {{name + ", point and distance",
         "error of t cos in units, and half ulps of the size off the surface", kScore, kScore},
        {name + ", hit or miss", "", kNoLimit, kNoLimit, 0}},
       200'000,
       100'000'000,
       4096,
       [random_target](KernelKind kernel) -> Chunk {
         return [kernel, random_target](Random& random, std::uint64_t trials,
                                        std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerShape) {
             const Target target = random_target(random);
             const double far = random.decade(0.5, 7);
             const auto scene =
                 compile_alone(target.shape, target.corners[0] + glm::dvec3(0, 0, far), kernel);
             std::vector<Ray> rays(kRaysPerShape);
             for (Ray& ray : rays) {
               const glm::dvec3 point = aim(random, target);
               ray.direction = random.direction();
               if (random.chance(0.5)) {
                 const glm::dvec3 n(solid_normal(target.shape, V(point)));
                 ray.direction = glm::normalize(random.across(n) + random.decade(-6, -2) * n);
               }
               ray.origin = point - far * ray.direction;
             }
             const auto hits = trace_all(*scene, rays);
             for (std::size_t i = 0; i < rays.size(); ++i) {
               judge(*scene, target, rays[i], hits[i], tallies);
             }
           }
         };
       }});
}

}  // namespace

void add_polyhedron_tests(std::vector<Test>& tests) {
  add(tests, "box", random_box);
  add(tests, "pyramid", random_pyramid);
}

}  // namespace lightbench::stress
