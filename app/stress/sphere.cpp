// Rays and a sphere from 1e-6 to 1e8 radii away, against long double.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

const SphereShape kSphere{.center = {3, -7, 11}, .radius = 0.75};

/// A ray that passes the centre within 1.2 radii, from `far` radii away.
Ray ray_from_afar(Random& random, double far) {
  const glm::dvec3 w = random.direction(), s = random.across(w);
  const double sine = std::min(1.0, 1.2 * random.unit() / far);
  Ray ray;
  ray.origin = kSphere.center + (far * kSphere.radius) * w;
  ray.direction = random.decade(-4, 4) * (sine * s - std::sqrt(1 - sine * sine) * w);
  return ray;
}

/// So many radii from the centre, in any direction.
Ray ray_from(Random& random, double radii) {
  Ray ray;
  ray.origin = kSphere.center + (radii * kSphere.radius) * random.direction();
  ray.direction = random.decade(-4, 4) * random.direction();
  return ray;
}

enum SphereLine { kOff, kDistance, kNormal, kWrong };
/// A ray that starts this many roundings of its coordinates from the surface, or less, may be told
/// either end.
constexpr double kOnSurface = 4;

void judge(const RenderScene& scene, const Ray& ray, const std::optional<Hit>& hit,
           std::span<Tally> tallies) {
  const OracleRay exact = exact_ray(scene, ray);
  const V center(kSphere.center);
  const auto r = static_cast<Number>(kSphere.radius);
  const Number away = glm::length(exact.o - center);
  const Number along = glm::dot(center - exact.o, exact.d) / glm::dot(exact.d, exact.d);
  const V closest = exact.o - center + along * exact.d;
  const Number impact = glm::length(closest) / r;
  const Span span = solid_span(kSphere, exact);
  Number t = span.near > 0 ? span.near : span.far;
  const bool expected = span.hit && t > 0;
  const auto text = [&] { return fmt::format("{} {}", to_text(Shape(kSphere)), to_text(ray)); };

  tallies[kWrong].trial();
  if (hit.has_value() != expected) {
    // Where rounding the sphere to the kernel's numbers may decide; float is not forgiven.
    const bool strict = precision_of(scene.kernel) == Precision::Float;
    const Number margin = Number(1e-14L) * std::max(Number(1), away / r);
    if (strict || std::abs(impact - 1) > margin) {
      tallies[kWrong].fail([&] { return (expected ? "missed: " : "hit: ") + text(); });
    }
  }
  if (!hit || !expected) return;
  const V p = exact_position(*hit) - center;
  tallies[kOff].trial();
  tallies[kOff].measure(static_cast<double>(std::abs(glm::length(p) / r - 1)), text);
  if (impact > Number(0.999L)) return;
  const Number scale = std::max(away, r);
  const Number told = told_distance(ray, *hit);
  if (std::abs(span.near) < kOnSurface * rounding_of(scene) * scale)
    t = std::abs(told - span.near) < std::abs(told - span.far) ? span.near : span.far;
  tallies[kDistance].trial();
  tallies[kDistance].measure(static_cast<double>(std::abs(told - t) / scale), text);
  const V normal = (exact.o - center + t * exact.d) / r;
  tallies[kNormal].trial();
  tallies[kNormal].measure(
      static_cast<double>(glm::length(V(hit->geometric_normal) - normal) / (1 + away / r)), text);
}

std::vector<Line> lines(const std::string& where) {
  return {{"sphere " + where + ", off the surface", "distance from the surface / r", 1e-14, 4e-7},
          {"sphere " + where + ", distance", "error of t / max(distance, r), b < .999 r", 1e-14,
           5.4e-6},
          {"sphere " + where + ", normal", "error / (1 + distance/r), b < .999 r", 3e-15, 1.6e-6},
          {"sphere " + where + ", hit or miss", "", kNoLimit, kNoLimit, 1e-6}};
}

void add_near(std::vector<Test>& tests, const std::string& where, const std::string& distribution,
              Ray (*random_ray)(Random&)) {
  tests.push_back({"sphere " + where, distribution, lines(where), 500'000, 500'000'000, 8192,
                   [random_ray](KernelKind kernel) -> Chunk {
                     const auto scene = compile_alone(kSphere, kSphere.center, kernel);
                     return [scene, random_ray](Random& random, std::uint64_t trials,
                                                std::span<Tally> tallies) {
                       std::vector<Ray> rays(trials);
                       for (Ray& ray : rays) ray = random_ray(random);
                       const auto hits = trace_all(*scene, rays);
                       for (std::size_t i = 0; i < trials; ++i) {
                         judge(*scene, rays[i], hits[i], tallies);
                       }
                     };
                   }});
}

}  // namespace

void add_sphere_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"sphere far",
       "distance/r 10^U(0,8), impact U(0,1.2) r, |d| 10^U(-4,4); double: no verdict on hit or miss "
       "within 1e-14 distance/r of the outline",
       lines("far"), 1'200'000, 1'000'000'000, 8192, [](KernelKind kernel) -> Chunk {
         std::vector<std::shared_ptr<const RenderScene>> scenes;
         for (int decade = 0; decade < 8; ++decade) {
           const glm::dvec3 eye(0, 0, kSphere.radius * std::pow(10, decade + 1));
           scenes.push_back(compile_alone(kSphere, kSphere.center + eye, kernel));
         }
         return [scenes](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           const std::size_t decade = static_cast<std::size_t>(random.below(8));
           const auto low = static_cast<double>(decade);
           std::vector<Ray> rays(trials);
           for (Ray& ray : rays) ray = ray_from_afar(random, random.decade(low, low + 1));
           const auto hits = trace_all(*scenes[decade], rays);
           for (std::size_t i = 0; i < trials; ++i) {
             judge(*scenes[decade], rays[i], hits[i], tallies);
           }
         };
       }});
  add_near(tests, "inside", "10^U(-6,0) r from the centre, any direction",
           [](Random& random) { return ray_from(random, random.decade(-6, 0)); });
  add_near(tests, "near", "10^U(-6,0) r above the surface, any direction",
           [](Random& random) { return ray_from(random, 1 + random.decade(-6, 0)); });
}

}  // namespace lightbench::stress
