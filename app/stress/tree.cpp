// The trees over objects and triangles against a loop over all of them: the same distance to the
// bit, and the same surface, or one that ties with it.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/stress/kernel_functions.h"
#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"
#include "core/scene/transform.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerScene = 256;
/// More than the tiny scenes that are traced without a tree have.
constexpr int kObjects = 72;

/// Triangles anywhere in a cube, of all sizes down to a thousandth.
Mesh triangle_soup(Random& random) {
  Mesh mesh;
  for (std::uint32_t k = 0; k < 60; ++k) {
    const glm::dvec3 p = random.in_cube(0.5);
    const double size = random.decade(-3, 0);
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(p + random.in_cube(size));
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  return mesh;
}

/// All shapes, a third of the spheres moving, meshes several times over, some objects twice.
Scene random_scene(Random& random) {
  Scene scene = empty_scene();
  add_mesh(scene, cube_mesh(0.5));
  add_mesh(scene, triangle_soup(random));
  for (int i = 2; i < kObjects; ++i) {
    if (random.chance(0.05)) {
      scene.objects.push_back(scene.objects.back());  // equal distances: the first must win
      continue;
    }
    const Kind kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
    Transform transform;
    transform.translation = random.in_cube(4);
    transform.axis = random.direction();
    transform.degrees = random.chance(0.5) ? random.between(0, 360) : 0;
    transform.scale = glm::dvec3(random.decade(-2, 0.3));
    if (kind != Kind::Box && random.chance(0.3)) transform.scale.x *= random.between(-1, -0.1);
    Shape shape =
        kind == Kind::Mesh ? Shape(MeshShape{random.below(2)}) : random_shape(random, kind);
    if (auto* sphere = std::get_if<SphereShape>(&shape); sphere != nullptr && random.chance(0.3)) {
      sphere->motion = random.in_cube(3);
    }
    add_object(scene, shape, transform);
  }
  return scene;
}

/// A direction that is unit to the last bit: distances along it are the kernel's own numbers.
bool make_unit(glm::dvec3& d) {
  for (int i = 0; i < 8; ++i) {
    const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    const double length = largest * glm::length(d / largest);
    if (length == 1) return true;
    d /= length;
  }
  return false;
}

Ray random_ray(Random& random, const Scene& scene) {
  for (;;) {
    Ray ray;
    ray.origin = random.in_cube(5);
    ray.direction = random.direction();
    ray.time = random.unit();
    if (random.chance(0.5)) {
      const Object& o = scene.objects[static_cast<std::size_t>(random.below(kObjects))];
      const glm::dvec3 end = std::holds_alternative<MeshShape>(o.shape)
                                 ? random.in_cube(0.5)
                                 : random_end(random, o.shape);
      ray.direction = transform_point(object_to_world(o.transform), end) - ray.origin;
    }
    if (make_unit(ray.direction)) return ray;
  }
}

/// Of coinciding surfaces rounding may hide the first one's box behind the second, which the tree
/// then gives. So it may where a test of its choice alone meets it at the very distance of the
/// loop's.
bool is_tie(const RenderScene& scene, const Ray& ray, const LoopHit& tree, const LoopHit& loop) {
  if (tree.object == kNone || loop.object == kNone || tree.t != loop.t) return false;
  return functions_of(scene.kernel).hit_alone(scene, ray, tree.object, tree.triangle) == tree;
}

}  // namespace

void add_tree_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"tree",
       fmt::format(
           "scenes of {} objects of all shapes, a hundredfold apart in size, moving ones and "
           "instances of meshes among them; rays from anywhere among them, at any time, half "
           "of them aimed at corners, edges and rims",
           kObjects),
       {{"tree against a loop, nearest hit", "", kNoLimit, kNoLimit, 0},
        {"tree against a loop, any hit", "", kNoLimit, kNoLimit, 0}},
       40'000,
       10'000'000,
       2048,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerScene) {
             const Scene scene = random_scene(random);
             const auto compiled = compile(scene, kernel);
             std::vector<Ray> rays(kRaysPerScene);
             for (Ray& ray : rays) ray = random_ray(random, scene);
             const auto hits = trace_all(*compiled, rays);
             std::vector<std::uint8_t> blocked(rays.size());
             occluded(*compiled, rays, blocked);
             std::vector<LoopHit> loop(rays.size());
             functions_of(compiled->kernel).nearest_by_loop(*compiled, rays, loop);
             for (std::size_t i = 0; i < rays.size(); ++i) {
               const LoopHit tree =
                   hits[i] ? LoopHit{hits[i]->object, hits[i]->triangle, hits[i]->t} : LoopHit{};
               const auto text = [&] {
                 return fmt::format(
                     "{} at time {:.17g}: {}/{} at {:.17g}, the loop finds {}/{} at "
                     "{:.17g}",
                     to_text(rays[i]), rays[i].time, tree.object, tree.triangle, tree.t,
                     loop[i].object, loop[i].triangle, loop[i].t);
               };
               for (Tally& tally : tallies) tally.trial();
               if (tree != loop[i] && !is_tie(*compiled, rays[i], tree, loop[i])) {
                 tallies[0].fail(text);
               }
               if ((blocked[i] != 0) != (loop[i].object != kNone)) tallies[1].fail(text);
             }
           }
         };
       }});
}

}  // namespace lightbench::stress
