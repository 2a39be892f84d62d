// Rays from inside closed meshes, through the tree: none may get out, not through an edge and not
// through a vertex.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

using Index = std::uint32_t;

/// A sphere of `rows` x `columns`, poles included, its radius at (theta, phi) told by a function.
template <class Radius>
Mesh round_mesh(Index rows, Index columns, Radius radius) {
  Mesh mesh;
  const auto add = [&](double theta, double phi) {
    const double s = std::sin(theta);
    mesh.positions.push_back(radius(theta, phi) *
                             glm::dvec3(s * std::cos(phi), std::cos(theta), s * std::sin(phi)));
  };
  add(0, 0);
  for (Index i = 1; i < rows; ++i) {
    for (Index k = 0; k < columns; ++k) {
      add(std::numbers::pi * i / rows, 2 * std::numbers::pi * k / columns);
    }
  }
  add(std::numbers::pi, 0);
  const auto ring = [&](Index i, Index k) { return 1 + (i - 1) * columns + k % columns; };
  const Index last = static_cast<Index>(mesh.positions.size()) - 1;
  for (Index k = 0; k < columns; ++k) {
    mesh.triangles.push_back({0, ring(1, k + 1), ring(1, k)});
    mesh.triangles.push_back({last, ring(rows - 1, k), ring(rows - 1, k + 1)});
    for (Index i = 1; i + 1 < rows; ++i) {
      mesh.triangles.push_back({ring(i, k), ring(i, k + 1), ring(i + 1, k)});
      mesh.triangles.push_back({ring(i, k + 1), ring(i + 1, k + 1), ring(i + 1, k)});
    }
  }
  return mesh;
}

Mesh sphere_mesh() {
  return round_mesh(100, 200, [](double, double) { return 1.0; });
}
Mesh star_mesh() {
  return round_mesh(100, 200, [](double theta, double phi) {
    return 1 + 0.4 * std::sin(7 * theta) * std::cos(9 * phi) + 0.05 * std::sin(71 * phi + theta);
  });
}
/// Two fans of 2000 needles that share their rim: many triangles meet in one vertex.
Mesh fan_mesh() {
  return round_mesh(2, 2000, [](double, double) { return 1.0; });
}

/// A closed mesh in its place.
struct Room {
  Mesh mesh;
  glm::dvec3 middle{0};
  double size = 1;  ///< origins lie within this of the middle, which is inside
  std::shared_ptr<const RenderScene> scene;
};

Room make_room(Mesh mesh, double size, const glm::dvec3& middle, KernelKind kernel) {
  for (glm::dvec3& p : mesh.positions) p += middle;
  Room room{mesh, middle, size, nullptr};
  Scene scene = empty_scene();
  add_mesh(scene, std::move(mesh));
  scene.camera.look_from = middle;
  scene.camera.look_at = middle + glm::dvec3(0, 0, -1);
  room.scene = compile(scene, kernel);
  return room;
}

Ray aimed(Random& random, const Room& room) {
  Ray ray;
  // A quarter from the very middle, whose rays meet vertices and edges of symmetric meshes exactly.
  ray.origin = room.middle;
  if (random.chance(0.75)) ray.origin += random.in_cube(room.size * random.decade(-3, 0));
  const auto count = static_cast<int>(room.mesh.triangles.size());
  const auto& triangle = room.mesh.triangles[static_cast<std::size_t>(random.below(count))];
  const glm::dvec3 a = room.mesh.positions[triangle[0]], b = room.mesh.positions[triangle[1]];
  switch (random.below(3)) {
    case 0:
      ray.direction = a + random.unit() * (b - a) - ray.origin;
      break;
    case 1:
      ray.direction = a - ray.origin;
      break;
    default:
      ray.direction = random.direction();
  }
  return ray;
}

void add(std::vector<Test>& tests, const std::string& name, const std::string& what,
         const std::vector<double>& sizes, double inside, std::uint64_t short_trials,
         Mesh (*make)(double)) {
  tests.push_back(
      {"leaks of " + name,
       what + ", around 0 and around (148376,1234,-223423); origins inside; a third of the rays "
              "aimed at edges, a third at vertices, a third anywhere",
       {{"leaks of " + name, "", kNoLimit, kNoLimit, 0}},
       short_trials,
       250'000'000,
       8192,
       [sizes, inside, make](KernelKind kernel) -> Chunk {
         std::vector<Room> rooms;
         for (const double size : sizes) {
           for (const glm::dvec3& middle : {glm::dvec3(0), glm::dvec3(148376, 1234, -223423)}) {
             rooms.push_back(make_room(make(size), inside * size, middle, kernel));
           }
         }
         return [rooms](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           const Room& room =
               rooms[static_cast<std::size_t>(random.below(static_cast<int>(rooms.size())))];
           std::vector<Ray> rays(trials);
           for (Ray& ray : rays) ray = aimed(random, room);
           const auto hits = trace_all(*room.scene, rays);
           tallies[0].trial(trials);
           for (std::size_t i = 0; i < trials; ++i) {
             if (hits[i]) continue;
             tallies[0].fail([&] {
               return fmt::format("size {} at {}: {}", room.size, to_text(room.middle),
                                  to_text(rays[i]));
             });
           }
         };
       }});
}

}  // namespace

void add_mesh_leak_tests(std::vector<Test>& tests) {
  // The bumpy star is star-shaped around its middle, and everything within .1 of it is inside.
  add(tests, "a sphere mesh", "closed UV sphere of 100 x 200", {1}, 0.5, 3'200'000,
      [](double) { return sphere_mesh(); });
  add(tests, "a bumpy star", "closed star with bumps, 100 x 200", {1}, 0.1, 3'200'000,
      [](double) { return star_mesh(); });
  add(tests, "a cube of 12 triangles", "half sizes 1, 100 and 10000", {1, 100, 1e4}, 0.57,
      3'200'000, [](double half) { return cube_mesh(half); });
  add(tests, "fans of needles", "two fans of 2000 needles with a common rim", {1}, 0.2, 400'000,
      [](double) { return fan_mesh(); });
}

}  // namespace lightbench::stress
