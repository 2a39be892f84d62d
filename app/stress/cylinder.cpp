// Capped cylinders from thin plates to long needles, seen from all around, along the axis and from
// inside.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerCylinder = 128;

CylinderShape random_cylinder(Random& random) {
  const double height = random.decade(-1.5, 1.5), radius = height / random.decade(-3, 3);
  // Along a coordinate axis a ray can be exactly parallel in every number type.
  glm::dvec3 axis(0);
  if (random.chance(0.5)) {
    axis = random.direction();
  } else {
    axis[random.below(3)] = random.chance(0.5) ? 1 : -1;
  }
  const glm::dvec3 base = random.in_cube(4);
  return {base, base + height * axis, radius};
}

struct Question {
  Ray ray;
  double angle = 0;  ///< to the axis
};

/// Aimed at a point inside, at a rim, or near the side; from up to `far` sizes away or from inside.
Question ask(Random& random, const CylinderShape& s, double far) {
  const glm::dvec3 span = s.p1 - s.p0;
  const glm::dvec3 axis = glm::normalize(span), u = random.across(axis);
  const double size = std::max(glm::length(span), s.radius);
  const std::array<double, 4> shares = {random.unit(), 1.0, 1 + random.between(-1e-6, 1e-6),
                                        random.between(0, 1.2)};
  const double height = random.chance(0.5) ? random.unit() : (random.chance(0.5) ? 1.0 : 0.0);
  const glm::dvec3 target =
      s.p0 + height * span + (shares[static_cast<std::size_t>(random.below(4))] * s.radius) * u;
  Question q;
  q.angle = random.chance(0.1) ? 0 : random.decade(-7, std::log10(std::numbers::pi / 2));
  const double side = random.chance(0.5) ? 1 : -1;
  q.ray.direction = side * (std::cos(q.angle) * axis + std::sin(q.angle) * random.across(axis));
  if (q.angle == 0) q.ray.direction = side * axis;
  q.ray.origin = target - (far * size) * q.ray.direction;
  if (random.chance(0.2)) {
    q.ray.origin =
        s.p0 + random.unit() * span + (s.radius * std::sqrt(random.unit())) * random.across(axis);
  }
  return q;
}

enum CylinderLine { kOff, kWrong, kParallel };

void judge(const RenderScene& scene, const CylinderShape& s, const Question& q,
           const std::optional<Hit>& hit, std::span<Tally> tallies) {
  const OracleRay exact = exact_ray(scene, q.ray);
  const double height = glm::distance(s.p0, s.p1);
  const double smallest = std::min(s.radius, height), size = std::max(s.radius, height);
  const bool in_double = precision_of(scene.kernel) == Precision::Double;
  const Number margin = in_double ? 1e-9 * smallest : 4e-6 * size;
  const Span inner = solid_span(s, exact, -margin), outer = solid_span(s, exact, margin);
  const bool must = inner.hit && inner.far > margin;
  const bool must_not = !outer.hit || outer.far < 0;
  const auto text = [&] {
    return fmt::format("{} {}, {:.3g} rad from the axis", to_text(Shape(s)), to_text(q.ray),
                       q.angle);
  };
  if (must || must_not) {
    tallies[kWrong].trial();
    if (hit.has_value() != must) {
      tallies[kWrong].fail([&] { return (must ? "missed: " : "hit: ") + text(); });
    }
  }
  if (must && q.angle < 0.1) {
    tallies[kParallel].trial();
    if (!hit) tallies[kParallel].fail(text);
  }
  if (!hit || !must) return;
  const Number off = std::abs(outside_of(s, exact_position(*hit)));
  tallies[kOff].trial();
  tallies[kOff].measure(static_cast<double>(off / (in_double ? smallest : size)), text);
}

}  // namespace

void add_cylinder_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"cylinder",
       "height/r 10^U(-3,3), distance/size 10^U(0,4), 0 or 10^U(-7,.2) rad from the axis, half of "
       "them along coordinates; aimed inside, at rims and past them; a fifth from inside. No "
       "verdict within 1e-9 min(r, height) of the outline (float: 4e-6 size)",
       {{"cylinder, off the surface", "distance from it / min(r, height); float: / size", 3e-8,
         4e-7},
        {"cylinder, hit or miss", "", kNoLimit, kNoLimit, 0},
        {"cylinder, missed within .1 rad of the axis", "", kNoLimit, kNoLimit, 0}},
       400'000,
       100'000'000,
       4096,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerCylinder) {
             const CylinderShape s = random_cylinder(random);
             const double size = std::max(s.radius, glm::distance(s.p0, s.p1));
             const double far = random.decade(0, 4);
             const auto scene =
                 compile_alone(s, 0.5 * (s.p0 + s.p1) + glm::dvec3(0, 0, (far + 1) * size), kernel);
             std::vector<Question> questions(kRaysPerCylinder);
             std::vector<Ray> rays;
             for (Question& q : questions) {
               q = ask(random, s, far);
               rays.push_back(q.ray);
             }
             const auto hits = trace_all(*scene, rays);
             for (std::size_t i = 0; i < rays.size(); ++i) {
               judge(*scene, s, questions[i], hits[i], tallies);
             }
           }
         };
       }});
}

}  // namespace lightbench::stress
