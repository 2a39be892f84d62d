#pragma once
// One ray against a mesh: its own space, its BVH, eight triangles at a time.

#include "core/accel/bvh_walk.h"
#include "core/shapes/mesh.h"

LIGHTBENCH_KERNEL_BEGIN

/// Distance and triangle of a mesh's nearest hit in (t_min, t).
struct MeshHit {
  T t;
  std::uint32_t slot;
  T b1, b2;
  bool found, front;
};

/// Ray (already in the mesh's space) against a mesh. Skips the triangles named by from_slot and
/// skip_slot (kNoHit for none).
template <bool kShadow>
MeshHit hit_mesh(const MeshView<T>& mesh, const SingleRay& ray, T t_min, T t_max) {
  // Largest component of the direction last, as Woop's shear wants.
  const T ax = ray.d[0] < 0 ? -ray.d[0] : ray.d[0], ay = ray.d[1] < 0 ? -ray.d[1] : ray.d[1];
  const T az = ray.d[2] < 0 ? -ray.d[2] : ray.d[2];
  const unsigned z = ax >= ay && ax >= az ? 0U : (ay >= az ? 1U : 2U);
  const unsigned x = (z + 1) % 3, y = (z + 2) % 3;
  const T sz = T(1) / ray.d[z], sx = ray.d[x] * sz, sy = ray.d[y] * sz;
  MeshHit best{t_max, kNoHit, 0, 0, false, false};
  walk(mesh.nodes, nullptr, ray, best.t, [&](std::uint32_t child) {
    const std::uint32_t first_block = leaf_first(child);
    for (std::uint32_t b = first_block; b < first_block + leaf_count(child); ++b) {
      const TriangleBlock<T>& block = mesh.blocks[b];
      for (int k = 0; k < kBvhWidth; k += kLanes) {
        const auto vertex = [&](unsigned i) {
          return Vec{load_of_8(block.v[3 * i + x] + k) - Real(ray.o[x]),
                     load_of_8(block.v[3 * i + y] + k) - Real(ray.o[y]),
                     load_of_8(block.v[3 * i + z] + k) - Real(ray.o[z])};
        };
        const TriangleHit h =
            hit_sheared(vertex(0), vertex(1), vertex(2), Real(sx), Real(sy), Real(sz));
        std::uint32_t m = bits(h.hit && h.t > Real(t_min) && h.t <= Real(best.t));
        m &= (1U << (kBvhWidth - k)) - 1U;
        if (m == 0) continue;
        alignas(64) T ts[kLanes], b1[kLanes], b2[kLanes];
        store(ts, h.t);
        store(b1, h.b1);
        store(b2, h.b2);
        for (; m != 0; m &= m - 1) {
          const auto lane = static_cast<unsigned>(__builtin_ctz(m));
          const std::uint32_t slot = b * kBvhWidth + static_cast<unsigned>(k) + lane;
          if (slot == ray.from_slot || slot == ray.skip_slot) continue;
          if (ts[lane] < best.t || (ts[lane] == best.t && slot < best.slot)) {
            best = {ts[lane], slot, b1[lane], b2[lane], true, false};
            if (kShadow) return true;
          }
        }
      }
    }
    return false;
  });
  return best;
}

/// The ray in the space of mesh instance i.
inline SingleRay to_mesh_space(const SceneView<T>& scene, std::uint32_t i, const SingleRay& ray) {
  const T* m = scene.rows + scene.row[i];
  SingleRay r = ray;
  for (unsigned a = 0; a < 3; ++a) {
    r.o[a] = m[4 * a] * ray.o[0] + m[4 * a + 1] * ray.o[1] + m[4 * a + 2] * ray.o[2] + m[4 * a + 3];
    r.d[a] = m[4 * a] * ray.d[0] + m[4 * a + 1] * ray.d[1] + m[4 * a + 2] * ray.d[2];
    r.inverse[a] = T(1) / r.d[a];
  }
  r.from_slot = ray.from == i ? ray.from_slot : kNoHit;
  r.skip_slot = ray.skip == i ? ray.skip_slot : kNoHit;
  return r;
}

LIGHTBENCH_KERNEL_END
