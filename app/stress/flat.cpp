// Discs, rectangles and triangles: slivers, grazing and far, against long double.

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
/// Rounding errors are counted in units of this many half ulps of the ray's and the shape's extent.
constexpr double kScore = 8;

/// A flat shape about unit size with ways to aim at it.
struct Target {
  Shape shape;
  glm::dvec3 center{0}, u{0}, v{0};  ///< the points center + a u + b v of the parameters ...
  bool round = false;                ///< ... in the unit circle, or in the unit square
  bool triangular = false;           ///< a + b < 1 only
};

Target random_disc(Random& random) {
  const glm::dvec3 n = random.direction(), u = random.across(n);
  const DiscShape s{random.in_cube(2), n * random.decade(-3, 3), 1};
  return {s, s.center, u, glm::cross(n, u), true, false};
}

Target random_parallelogram(Random& random, bool triangle) {
  const glm::dvec3 n = random.direction(), u = random.across(n);
  const double skew = random.between(-1, 1);
  // Slivers: the height over the first edge, from 1 down to 1e-4.
  const glm::dvec3 v = random.decade(-4, 0) * glm::cross(n, u) + (triangle ? 0.5 + skew : 0) * u;
  const glm::dvec3 corner = random.in_cube(2);
  if (triangle) return {TriangleShape{corner, corner + u, corner + v}, corner, u, v, false, true};
  return {RectangleShape{corner, u, v}, corner, u, v, false, false};
}

glm::dvec3 aim(Random& random, const Target& target) {
  // In the middle, or within 1e-6 of the border on either side.
  const double near_one = 1 + random.between(-1e-6, 1e-6);
  if (target.round) {
    const double a = random.between(0, 6.283185307179586);
    const double r = random.chance(0.5) ? std::sqrt(random.unit()) : near_one;
    return target.center + (r * std::cos(a)) * target.u + (r * std::sin(a)) * target.v;
  }
  double a = random.unit(), b = random.unit();
  if (random.chance(0.5)) {
    const double edge = random.chance(0.5) ? near_one : near_one - 1;
    if (target.triangular && edge > 0.5) {
      b = edge - a;
    } else {
      (random.chance(0.5) ? a : b) = edge;
    }
  } else if (target.triangular && a + b > 1) {
    a = 1 - a;
    b = 1 - b;
  }
  return target.center + a * target.u + b * target.v;
}

enum FlatLine { kScored, kWrong };

void judge(const RenderScene& scene, const Target& target, const Ray& ray,
           const std::optional<Hit>& hit, std::span<Tally> tallies) {
  const OracleRay exact = exact_ray(scene, ray);
  const PlanePoint point = flat_point(target.shape, exact);
  const Number cosine = std::abs(glm::dot(point.normal, exact.d));
  // What rounding the ray's and the shape's numbers to half an ulp moves the hit by.
  const Number unit = rounding_of(scene) * (std::abs(point.t) + 1) / cosine;
  if (!std::isfinite(point.t)) return;
  const auto text = [&] {
    return fmt::format("{} {} cos {:.3g}", to_text(target.shape), to_text(ray),
                       static_cast<double>(cosine));
  };
  const bool clear = std::abs(point.inside) > kScore * unit && point.t > kScore * unit;
  const bool expected = point.inside > 0;
  if (clear) {
    tallies[kWrong].trial();
    if (hit.has_value() != expected) {
      tallies[kWrong].fail([&] { return (expected ? "missed: " : "hit: ") + text(); });
    }
  }
  if (!hit || !clear) return;
  const V p = exact_position(*hit);
  const Number error = std::max(glm::length(p - (exact.o + point.t * exact.d)),
                                std::abs(told_distance(ray, *hit) - point.t));
  const Number off = std::abs(off_plane(target.shape, p)) / (2 * rounding_of(scene));
  tallies[kScored].trial();
  tallies[kScored].measure(static_cast<double>(std::max(error / unit, off)), text);
}

enum class As { Itself, Mesh };

std::shared_ptr<const RenderScene> compile_target(const Shape& shape, As as, const glm::dvec3& eye,
                                                  KernelKind kernel) {
  if (as == As::Itself) return compile_alone(shape, eye, kernel);
  const auto& t = std::get<TriangleShape>(shape);
  Scene scene = empty_scene();
  scene.camera.look_from = eye;
  scene.camera.look_at = eye + glm::dvec3(0, 0, -1);
  add_mesh(scene, {{t.a, t.b, t.c}, {}, {}, {{0, 1, 2}}});
  return compile(scene, kernel);
}

void add(std::vector<Test>& tests, const std::string& name, Target (*random_target)(Random&),
         As as = As::Itself) {
  tests.push_back(
      {name,
       "slivers 10^U(-4,0), distance/size 10^U(0,7), grazing cos 10^U(-6,0), half of them within "
       "1e-6 of the border; no verdict on hit or miss within 8 units of the border. A unit is half "
       "an ulp of (distance + size) / cos",
       {{name + ", point and distance", "error in units, and ulps off the plane", kScore, kScore},
        {name + ", hit or miss", "", kNoLimit, kNoLimit, 0}},
       250'000,
       100'000'000,
       4096,
       [random_target, as](KernelKind kernel) -> Chunk {
         return [kernel, random_target, as](Random& random, std::uint64_t trials,
                                            std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerShape) {
             const Target target = random_target(random);
             const double far = random.decade(0, 7);
             const auto scene =
                 compile_target(target.shape, as, target.center + glm::dvec3(0, 0, far), kernel);
             std::vector<Ray> rays(kRaysPerShape);
             const glm::dvec3 n = glm::normalize(glm::cross(target.u, target.v));
             for (Ray& ray : rays) {
               const double cosine = random.decade(-6, 0) * (random.chance(0.5) ? 1 : -1);
               ray.direction = cosine * n + std::sqrt(1 - cosine * cosine) * random.across(n);
               ray.origin = aim(random, target) - far * ray.direction;
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

void add_flat_tests(std::vector<Test>& tests) {
  add(tests, "disc", random_disc);
  add(tests, "rectangle", [](Random& random) { return random_parallelogram(random, false); });
  const auto triangle = [](Random& random) { return random_parallelogram(random, true); };
  add(tests, "triangle", triangle);
  add(tests, "triangle of a mesh", triangle, As::Mesh);
}

}  // namespace lightbench::stress
