// Rays from inside solids: all of them must meet the surface.

#include <glm/geometric.hpp>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerShape = 128;

Ray aimed(Random& random, const Shape& shape) {
  glm::dvec3 inside = random_point(random, shape);
  if (random.chance(0.5)) {
    // Close below a face.
    const V d(random.direction());
    const Span span = solid_span(shape, {V(inside), d});
    const V p = V(inside) + span.far * d;
    inside = glm::dvec3(p - Number(random.decade(-12, -1)) * solid_normal(shape, p));
  }
  Ray ray;
  ray.origin = inside;
  ray.direction = random.chance(0.5) ? random_end(random, shape) - inside : random.direction();
  if (ray.direction == glm::dvec3(0)) ray.direction = {1, 0, 0};
  return ray;
}

void add(std::vector<Test>& tests, Kind kind) {
  const std::string name = std::string("leaks of a ") + name_of(kind);
  tests.push_back(
      {name,
       "closed " + std::string(name_of(kind)) +
           "; half of the origins 10^U(-12,-1) below a face, half of the rays aimed at corners, "
           "edges and rims; origins that rounding to the kernel's numbers moves out are left out",
       {{name, "", kNoLimit, kNoLimit, 0}},
       150'000,
       100'000'000,
       4096,
       [kind](KernelKind kernel) -> Chunk {
         return [kernel, kind](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerShape) {
             const Shape shape = random_shape(random, kind);
             const auto scene = compile_alone(shape, glm::dvec3(0), kernel);
             std::vector<Ray> rays(kRaysPerShape);
             for (Ray& ray : rays) ray = aimed(random, shape);
             const auto hits = trace_all(*scene, rays);
             for (std::size_t i = 0; i < rays.size(); ++i) {
               const Number depth = -outside_of(shape, exact_ray(*scene, rays[i]).o);
               if (depth < 8 * rounding_of(*scene)) continue;
               tallies[0].trial();
               if (hits[i]) continue;
               tallies[0].fail([&] { return to_text(shape) + " " + to_text(rays[i]); });
             }
           }
         };
       }});
}

}  // namespace

void add_solid_leak_tests(std::vector<Test>& tests) {
  for (const Kind kind : kKinds) {
    if (is_solid(kind)) add(tests, kind);
  }
}

}  // namespace lightbench::stress
