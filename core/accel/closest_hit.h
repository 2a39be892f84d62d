#pragma once
// Closest and any hit. Tiny scenes: every primitive against all lanes at once. Others: trees
// (tree_walk.h). Both find the same distance; of equal ones the smaller index wins, unless rounding
// hides its box behind the other.

#include "core/accel/tree_walk.h"

LIGHTBENCH_KERNEL_BEGIN

/// Finds the nearest hits before hit.t; with kShadow any hit will do. Without a tree closest hits
/// are looked for among `surfaces` only. Never inlined: within the step of the path tracer it would
/// take the inliner's budget from what is called there once per path.
template <bool kShadow>
[[gnu::noinline]] void find_hits(const SceneView<T>& scene, const Ray& ray, Mask active,
                                 NearestHit& hit, const Surfaces& surfaces = kAllSurfaces) {
  if (uses(scene, Feature::Tree)) {
    walk_trees<kShadow>(scene, ray, active, hit);
  } else {
    test_all<kShadow>(scene, ray, surfaces, active, hit);
  }
}

/// Distance and barycentrics of found hits on triangles, to the last bits. It comes after the
/// choice of the nearest, which goes by what the tests gave: so it costs once per ray, not once per
/// test.
inline void refine_hits(const SceneView<T>& scene, const Ray& ray, NearestHit& hit) {
  for_each_kind(scene, hit.primitive, Mask(true), [&]<PrimitiveKind kKind>(Mask m) {
    if constexpr (kKind == PrimitiveKind::Triangle || kKind == PrimitiveKind::Mesh) {
      const auto shape = shape_at<kKind>(rows_of<kKind>(scene, hit.primitive, m), ray.time);
      TriangleHit h{hit.t, hit.b1, hit.b2, m};
      if constexpr (kKind == PrimitiveKind::Mesh) {
        h = refine_triangle(fetch_vertices(scene, hit.primitive, hit.slot, m),
                            shape.to_local.point(ray.o), shape.to_local.vector(ray.d), h);
      } else {
        h = refine_triangle(shape, ray.o, ray.d, h);
      }
      hit.t = select(m, h.t, hit.t);
      hit.b1 = select(m, h.b1, hit.b1);
      hit.b2 = select(m, h.b2, hit.b2);
    }
  });
}

LIGHTBENCH_KERNEL_END
