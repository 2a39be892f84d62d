#pragma once
// Closest and any hit. Tiny scenes: every primitive against all lanes at once. Others: each lane's
// ray walks the eight-wide BVH, one ray against eight boxes or eight triangles. Both find the same
// distance; of equal ones the smaller index wins, unless rounding hides its box behind the other.

#include "core/accel/mesh_hit.h"
#include "core/accel/primitive_hit.h"

LIGHTBENCH_KERNEL_BEGIN

/// Finds the nearest hits before hit.t; with kShadow any hit will do. Never inlined: within the
/// step of the path tracer it would take the inliner's budget from what is called there once per
/// path.
template <bool kShadow>
[[gnu::noinline]] void find_hits(const SceneView<T>& scene, const Ray& ray, Mask active,
                                 NearestHit& hit) {
  if (scene.nodes == nullptr) {
    test_all<kShadow>(scene, ray, active, hit);
    return;
  }
  const RayTable rays(ray);
  alignas(64) T t[kLanes], b1[kLanes], b2[kLanes];
  alignas(64) std::uint32_t primitive[kLanes], slot[kLanes];
  store(t, hit.t);
  store(b1, hit.b1);
  store(b2, hit.b2);
  store(primitive, hit.primitive);
  store(slot, hit.slot);
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const SingleRay one = rays.single(lane);
    const Ray all = broadcast_ray(one);
    walk(scene.nodes, scene.motion, one, t[lane], [&](std::uint32_t child) {
      const std::uint32_t end = leaf_first(child) + leaf_count(child);
      for (std::uint32_t k = leaf_first(child); k < end; ++k) {
        const std::uint32_t i = scene.leaves[k];
        if (scene.kind[i] == static_cast<std::uint32_t>(PrimitiveKind::Mesh)) {
          const MeshHit h =
              hit_mesh<kShadow>(mesh_of(scene, i), to_mesh_space(scene, i, one), T(0), t[lane]);
          if (h.found && (h.t < t[lane] || i < primitive[lane])) {
            t[lane] = h.t;
            b1[lane] = h.b1;
            b2[lane] = h.b2;
            primitive[lane] = i;
            slot[lane] = h.slot;
          }
        } else {
          NearestHit h{Real(t[lane]), Int(primitive[lane]), Int(0U), Real(b1[lane]),
                       Real(b2[lane])};
          with_kind(scene, i, [&]<PrimitiveKind kKind>() {
            test_primitive<kShadow, kKind, TestOrder::Any>(scene, i, all, Mask(true), h);
          });
          t[lane] = first(h.t);
          b1[lane] = first(h.b1);
          b2[lane] = first(h.b2);
          primitive[lane] = first(h.primitive);
        }
        if (kShadow && primitive[lane] != kNoHit) return true;
      }
      return false;
    });
  }
  hit = {load(t), load(primitive), load(slot), load(b1), load(b2)};
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
        h = refine_triangle(fetch_triangles(scene, hit.primitive, hit.slot, m).vertices,
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
