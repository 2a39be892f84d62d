// Rays put to compiled scenes: many at once are as many alone, and nothing is lost at the border
// between the scene's units and the kernel's.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/query/convert.h"
#include "core/query/rays.h"
#include "tests/unit/query_support.h"

namespace lightbench {
namespace {

using glm::dvec3;

const char* const kScenes[] = {"cornell-three-lights.json", "cornell-smoke.json",
                               "features/shape-lights.json", "features/shape-mesh.json",
                               "features/motion-blur.json"};

bool same(const Hit& a, const Hit& b) {
  return a.object == b.object && a.t == b.t && a.position == b.position &&
         a.geometric_normal == b.geometric_normal && a.shading_normal == b.shading_normal &&
         a.tangent == b.tangent && a.u == b.u && a.v == b.v && a.front == b.front &&
         a.triangle == b.triangle && a.position_remainder == b.position_remainder;
}

TEST(RayQueries, ManyAtOnceAreAsManyAlone) {
  for (const char* name : kScenes) {
    const Scene scene = stored_scene(name);
    const std::vector<Ray> rays = picture_rays(scene, 301);
    std::vector<std::optional<Hit>> first;
    for (const KernelKind kind : kernels()) {
      const auto compiled = compile(scene, kind);
      std::vector<std::optional<Hit>> hits(rays.size());
      std::vector<std::uint8_t> blocked(rays.size());
      trace(*compiled, rays, hits);
      occluded(*compiled, rays, blocked);
      int found = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto alone = trace(*compiled, rays[i]);
        ASSERT_EQ(alone.has_value(), hits[i].has_value()) << name;
        EXPECT_EQ(blocked[i] != 0, alone.has_value()) << name;
        if (!alone) continue;
        ++found;
        EXPECT_TRUE(same(*alone, *hits[i])) << name;
        // The float kernels answer alike.
        if (kind != KernelKind::Reference && !first.empty()) {
          EXPECT_TRUE(same(*first[i], *hits[i])) << name;
        }
      }
      EXPECT_GT(found, 30) << name;
      if (first.empty()) first = hits;
    }
  }
}

TEST(RayQueries, TheRayStaysWithinItsEnds) {
  const Scene scene = stored_scene("features/shape-lights.json");
  for (const KernelKind kind : kernels()) {
    const auto compiled = compile(scene, kind);
    int second = 0;
    for (const Ray& ray : picture_rays(scene, 200)) {
      const auto hit = trace(*compiled, ray);
      if (!hit) continue;
      EXPECT_NEAR(glm::length(ray.origin + hit->t * ray.direction - hit->position), 0,
                  1e-4 * glm::length(hit->position - ray.origin));
      Ray part = ray;
      part.t_max = hit->t * 0.999;
      EXPECT_FALSE(trace(*compiled, part).has_value());
      EXPECT_FALSE(occluded(*compiled, part));
      part = ray;
      part.t_min = hit->t * 0.999;
      const auto again = trace(*compiled, part);
      ASSERT_TRUE(again.has_value());
      EXPECT_EQ(again->object, hit->object);
      EXPECT_NEAR(again->t, hit->t, 1e-5 * hit->t);
      part.t_min = hit->t * 1.001;
      const auto behind = trace(*compiled, part);
      if (behind) {
        EXPECT_GE(behind->t, part.t_min);
      }
      second += behind ? 1 : 0;
      part.t_max = part.t_min;
      EXPECT_FALSE(trace(*compiled, part).has_value());
    }
    EXPECT_GT(second, 20);
  }
}

TEST(RayQueries, SpawnedRaysNeverMeetWhatTheyLeft) {
  Random random;
  // Far from 0, where doubles are coarser than the kernel's own points.
  for (const double offset : {0.0, 1e9}) {
    Scene scene;
    scene.materials.resize(1);
    scene.objects.resize(2);
    scene.objects[0].shape = SphereShape{{offset, offset, 0}, 1, {0, 0, 0}};
    scene.objects[1].shape = BoxShape{{offset + 2, offset, 0}, {offset + 3, offset + 1, 1}};
    for (Object& object : scene.objects) object.material = 0;
    for (const KernelKind kind : kernels()) {
      const auto compiled = compile(scene, kind);
      int hits = 0;
      for (int i = 0; i < 2000; ++i) {
        const dvec3 target{offset + random.between(-1, 3), offset + random.between(-1, 1),
                           random.between(-1, 1)};
        Ray ray;
        ray.origin = target + 8.0 * random.direction();
        ray.direction = target - ray.origin;
        const auto hit = trace(*compiled, ray);
        if (!hit) continue;
        ++hits;
        dvec3 away = random.direction();
        if (glm::dot(away, hit->geometric_normal) < 0) away = -away;
        const Ray outward = spawn(*compiled, *hit, away);
        EXPECT_FALSE(outward.from.inside);
        const auto other = trace(*compiled, outward);
        EXPECT_TRUE(!other || other->object != hit->object);
        const Ray inward = spawn(*compiled, *hit, -away);
        EXPECT_TRUE(inward.from.inside);
        const auto exit = trace(*compiled, inward);
        ASSERT_TRUE(exit.has_value()) << "a leak";
        EXPECT_EQ(exit->object, hit->object);
        EXPECT_FALSE(exit->front);
      }
      EXPECT_GT(hits, 500) << kernel_name(kind);
    }
  }
}

TEST(RayQueries, PointsCrossTheBorderUnchanged) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    RenderSpace space;
    space.scale = std::ldexp(1.0, static_cast<int>(random.between(-40, 40)));
    const double distance = std::exp(random.between(-20, 40)) / space.scale;
    space.center = random.direction() * distance;
    const dvec3 q = random.direction() * std::exp(random.between(-20, 2));
    dvec3 p, remainder;
    to_scene(space, q, p, remainder);
    EXPECT_EQ(to_render(space, p, remainder), q);
  }
}

// Float kernels work at unit size, in which scene units are no round numbers: double has bits to
// spare for the way there and back.
TEST(RayQueries, FloatPointsCrossTheBorderAtAnyScaleUnchanged) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    RenderSpace space;
    space.scale = std::exp(random.between(-30, 30));
    space.center = random.direction() * (std::exp(random.between(-20, 15)) / space.scale);
    const glm::vec3 q(random.direction() * std::exp(random.between(-20, 2)));
    dvec3 p, remainder;
    to_scene(space, dvec3(q), p, remainder);
    EXPECT_EQ(glm::vec3(to_render(space, p, remainder)), q);
  }
}

TEST(RayQueries, AMeshNamesItsTriangle) {
  const Scene scene = stored_scene("features/instances.json");
  const auto compiled = compile(scene, KernelKind::Auto);
  int triangles = 0;
  for (const Ray& ray : picture_rays(scene, 300)) {
    const auto hit = trace(*compiled, ray);
    if (!hit) continue;
    const Object& object = scene.objects[static_cast<std::size_t>(hit->object)];
    const auto* shape = std::get_if<MeshShape>(&object.shape);
    ASSERT_EQ(hit->triangle != kNone, shape != nullptr);
    if (shape == nullptr) continue;
    ++triangles;
    const Mesh& mesh = *scene.meshes[static_cast<std::size_t>(shape->mesh)].data;
    ASSERT_LT(hit->triangle, static_cast<int>(mesh.triangles.size()));
    // Leaving that triangle, the ray goes on; leaving another, it meets this one.
    Ray again = ray;
    again.from = {hit->object, hit->triangle, false};
    const auto next = trace(*compiled, again);
    EXPECT_TRUE(!next || next->triangle != hit->triangle || next->object != hit->object);
    again.from.triangle = hit->triangle == 0 ? 1 : 0;
    EXPECT_EQ(trace(*compiled, again)->triangle, hit->triangle);
  }
  EXPECT_GT(triangles, 25);
}

TEST(RayQueries, TheRoundedRayIsTheRayTraced) {
  const Scene scene = stored_scene("cornell-three-lights.json");
  const auto compiled = compile(scene, KernelKind::Scalar);
  for (const Ray& ray : picture_rays(scene, 50)) {
    const Ray seen = as_traced(*compiled, ray);
    EXPECT_NEAR(glm::length(seen.direction), 1, 1e-7);
    const Ray again = as_traced(*compiled, seen);
    EXPECT_EQ(again.origin, seen.origin);
    EXPECT_NEAR(glm::length(seen.origin - ray.origin), 0, 1e-6 * glm::length(ray.origin));
    const auto a = trace(*compiled, ray), b = trace(*compiled, seen);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_NEAR(a->t * glm::length(ray.direction), b->t, 1e-5 * b->t);
    }
  }
}

TEST(RayQueries, SliversOfPyramidsAreMetWhereTheyAre) {
  // The face of vertices 1 to 3 is .85 long and .0006 high. Its plane once was tilted along it.
  Scene scene;
  scene.materials.emplace_back();
  Object object;
  object.name = "pyramid";
  object.material = 0;
  object.shape =
      PyramidShape{{dvec3(1.1469526109960895, 0.66772075586474822, -0.35665148707781363),
                    dvec3(1.9929752818989264, 0.50680153045563558, -0.68972553476287379),
                    dvec3(1.3535190712908953, -0.32749948413690855, -0.25625964334926665),
                    dvec3(1.6736209253759169, 0.090270080001882136, -0.47338623084646458)}};
  scene.objects.push_back(object);
  const Ray ray{dvec3(10.45947663174552, 5.9997511436494273, -12.470954075399847),
                dvec3(-0.5516841359760053, -0.38208284738095327, 0.74138877240599732)};
  const auto hit = trace(*compile(scene, KernelKind::Reference), ray);
  ASSERT_TRUE(hit);
  // From long double; it was 2.4e-13 off.
  EXPECT_NEAR(hit->t, 16.444522742025949, 3e-14);
}

}  // namespace
}  // namespace lightbench
