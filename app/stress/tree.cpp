// The tree over objects against a loop over all of them: the same nearest object at the same
// distance, to the bit.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"
#include "core/query/lights.h"
#include "core/scene/transform.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerScene = 256;
constexpr int kObjects = 40;

/// Every object emits: a light can be asked for alone, whatever is in the way.
Scene random_scene(Random& random) {
  Scene scene = empty_scene();
  scene.materials[0].kind = MaterialKind::Emissive;
  scene.materials[0].emissive = glm::dvec3(1);
  scene.materials[0].two_sided = true;
  for (int i = 0; i < kObjects; ++i) {
    const Kind kind = kKinds[random.below(static_cast<int>(std::size(kKinds)) - 1)];
    Transform transform;
    transform.translation = random.in_cube(4);
    transform.axis = random.direction();
    transform.degrees = random.chance(0.5) ? random.between(0, 360) : 0;
    transform.scale = glm::dvec3(random.decade(-2, 0.3));
    if (kind != Kind::Box && random.chance(0.3)) transform.scale.x *= random.between(0.1, 1);
    add_object(scene, random_shape(random, kind), transform);
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
    if (random.chance(0.5)) {
      const Object& o = scene.objects[static_cast<std::size_t>(random.below(kObjects))];
      const glm::dvec3 end = random_end(random, o.shape);
      ray.direction = transform_point(object_to_world(o.transform), end) - ray.origin;
    }
    if (make_unit(ray.direction)) return ray;
  }
}

/// The nearest of all objects by asking each alone.
struct Nearest {
  int object = kNone;
  double t = std::numeric_limits<double>::infinity();
};
Nearest nearest_of(const RenderScene& scene, std::span<const LightPoint> each) {
  Nearest nearest;
  for (std::size_t light = 0; light < each.size(); ++light) {
    const LightPoint& p = each[light];
    if (!p.valid) continue;
    const int object = light_source(scene, static_cast<int>(light)).object;
    if (p.distance < nearest.t || (p.distance == nearest.t && object < nearest.object)) {
      nearest = {object, p.distance};
    }
  }
  return nearest;
}

}  // namespace

void add_tree_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"tree",
       fmt::format("scenes of {} objects of all shapes but meshes, a hundredfold apart in size; "
                   "rays from anywhere among them, half of them aimed at corners, edges and rims",
                   kObjects),
       {{"tree against a loop, nearest hit", "", kNoLimit, kNoLimit, 0},
        {"tree against a loop, any hit", "", kNoLimit, kNoLimit, 0}},
       30'000,
       10'000'000,
       2048,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerScene) {
             const Scene scene = random_scene(random);
             const auto compiled = compile(scene, kernel);
             std::vector<Ray> rays(kRaysPerScene);
             std::vector<LightDirection> alone;
             for (Ray& ray : rays) {
               ray = random_ray(random, scene);
               for (int light = 0; light < kObjects; ++light) {
                 alone.push_back({ray.origin, ray.direction, light, 0});
               }
             }
             const auto hits = trace_all(*compiled, rays);
             std::vector<std::uint8_t> blocked(rays.size());
             occluded(*compiled, rays, blocked);
             std::vector<LightPoint> points(alone.size());
             pdf_lights(*compiled, alone, points);
             for (std::size_t i = 0; i < rays.size(); ++i) {
               const std::span<const LightPoint> each(&points[i * kObjects], kObjects);
               const Nearest nearest = nearest_of(*compiled, each);
               const Nearest found = hits[i] ? Nearest{hits[i]->object, hits[i]->t} : Nearest{};
               const auto text = [&] {
                 return fmt::format("{}: object {} at {:.17g}, the loop finds {} at {:.17g}",
                                    to_text(rays[i]), found.object, found.t, nearest.object,
                                    nearest.t);
               };
               for (Tally& tally : tallies) tally.trial();
               if (found.object != nearest.object || found.t != nearest.t) tallies[0].fail(text);
               if ((blocked[i] != 0) != (nearest.object != kNone)) tallies[1].fail(text);
             }
           }
         };
       }});
}

}  // namespace lightbench::stress
