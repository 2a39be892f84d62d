#pragma once
// One ray against a mesh: in the mesh's own space, eight triangles at a time.

#include "core/accel/bvh_walk.h"
#include "core/shapes/mesh.h"
#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

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

/// The same in all lanes, to the same bits.
inline Ray to_mesh_space(const SceneView<T>& scene, std::uint32_t i, const Ray& ray) {
  const T* m = scene.rows + scene.row[i];
  const auto along = [m](unsigned a, Vec v) {
    return Real(m[4 * a]) * v.x + Real(m[4 * a + 1]) * v.y + Real(m[4 * a + 2]) * v.z;
  };
  Ray r = ray;
  r.o = {along(0, ray.o) + Real(m[3]), along(1, ray.o) + Real(m[7]), along(2, ray.o) + Real(m[11])};
  r.d = {along(0, ray.d), along(1, ray.d), along(2, ray.d)};
  r.from_slot = select(ray.from == Int(i), ray.from_slot, Int(kNoHit));
  r.skip_slot = select(ray.skip == Int(i), ray.skip_slot, Int(kNoHit));
  return r;
}

/// What the triangle tests need of a ray in a mesh's space: the largest component of its direction
/// is z, as Woop's shear wants.
struct MeshRay {
  unsigned x, y, z;
  T o[3];  ///< in that order
  T sx, sy, sz;
  std::uint32_t from_slot, skip_slot;  ///< triangles that it cannot meet, kNoHit for none
  const TriangleBlock<T>* blocks;
};

inline MeshRay mesh_ray(const SingleRay& ray, const MeshView<T>& mesh) {
  const T ax = ray.d[0] < 0 ? -ray.d[0] : ray.d[0], ay = ray.d[1] < 0 ? -ray.d[1] : ray.d[1];
  const T az = ray.d[2] < 0 ? -ray.d[2] : ray.d[2];
  MeshRay r;
  r.z = ax >= ay && ax >= az ? 0U : (ay >= az ? 1U : 2U);
  r.x = (r.z + 1) % 3;
  r.y = (r.z + 2) % 3;
  r.o[0] = ray.o[r.x];
  r.o[1] = ray.o[r.y];
  r.o[2] = ray.o[r.z];
  r.sz = T(1) / ray.d[r.z];
  r.sx = ray.d[r.x] * r.sz;
  r.sy = ray.d[r.y] * r.sz;
  r.from_slot = ray.from_slot;
  r.skip_slot = ray.skip_slot;
  r.blocks = mesh.blocks;
  return r;
}

/// Calls hit(t, slot, b1, b2) for each triangle of block b that the ray meets in (t_min, t_max].
template <class F>
void hit_block(const MeshRay& ray, std::uint32_t b, T t_min, T t_max, F hit) {
  const TriangleBlock<T>& block = ray.blocks[b];
  for (unsigned column = 0; column < kBvhWidth; column += kPart) {
    const auto vertex = [&](unsigned i) {
      return ShearedVertex<Part>{load_part(block.v[3 * i + ray.x] + column) - Part(ray.o[0]),
                                 load_part(block.v[3 * i + ray.y] + column) - Part(ray.o[1]),
                                 load_part(block.v[3 * i + ray.z] + column) - Part(ray.o[2])};
    };
    const ShearedHit<Part> h =
        hit_sheared(vertex(0), vertex(1), vertex(2), Part(ray.sx), Part(ray.sy), Part(ray.sz));
    std::uint32_t m = bits(h.hit && h.t > Part(t_min) && h.t <= Part(t_max));
    if (m == 0) continue;
    alignas(64) T t[kPart], b1[kPart], b2[kPart];
    store(t, h.t);
    store(b1, h.b1);
    store(b2, h.b2);
    for (; m != 0; m &= m - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctz(m));
      const std::uint32_t slot = b * kBvhWidth + column + k;
      if (slot != ray.from_slot && slot != ray.skip_slot) hit(t[k], slot, b1[k], b2[k]);
    }
  }
}

/// Distance and triangle of a mesh's nearest hit in (t_min, t_max].
struct MeshHit {
  T t;
  std::uint32_t slot;
  bool found;
};

/// Ray (already in the mesh's space) against a mesh alone.
inline MeshHit hit_mesh(const MeshView<T>& mesh, const SingleRay& ray, T t_min, T t_max) {
  BvhRays<1> boxes;
  set_ray(boxes, 0, ray, mesh.nodes, nullptr);
  set_limit(boxes, 0, t_max);
  const MeshRay triangles = mesh_ray(ray, mesh);
  MeshHit best{t_max, kNoHit, false};
  BvhStack stack;
  push(stack, 0, kDone);
  visit_node<false>(boxes, 0, 0, stack);
  for (;;) {
    const std::uint32_t child = pop(stack, boxes.limit[0]);
    if (child == kDone) return best;
    if (!is_leaf(child)) {
      visit_node<false>(boxes, 0, child, stack);
      continue;
    }
    hit_block(triangles, leaf_first(child), t_min, best.t, [&](T t, std::uint32_t slot, T, T) {
      if (t < best.t || (t == best.t && slot < best.slot)) best = {t, slot, true};
    });
    set_limit(boxes, 0, best.t);
  }
}

LIGHTBENCH_KERNEL_END
