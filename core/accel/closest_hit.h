#pragma once
// Closest and any hit. Tiny scenes: every primitive against all lanes at once. Others: each lane's
// ray walks the eight-wide BVH, one ray against eight boxes or eight triangles. Both find the same
// distance; of equal ones the smaller index wins, unless rounding hides its box behind the other.

#include "core/accel/mesh_hit.h"
#include "core/accel/primitive_hit.h"
#include "core/kernel/uses.h"

LIGHTBENCH_KERNEL_BEGIN

/// A lane's ray on its way through the scene's tree and those of meshes, and the nearest hit so
/// far. The size keeps the busy parts of sixteen of them in different sets of the cache.
struct alignas(64) Walk {
  BvhRay boxes;
  MeshRay triangles;
  std::uint32_t instance;  ///< the mesh whose tree it is in, kNoHit: the scene's
  int floor;               ///< size of the stack at which it leaves that mesh
  T t, b1, b2;
  std::uint32_t primitive, slot;
  BvhStack stack;
};

inline bool is_mesh(const SceneView<T>& scene, std::uint32_t i) {
  return scene.kind[i] == static_cast<std::uint32_t>(PrimitiveKind::Mesh);
}

/// `local` is the ray in the space of mesh instance i.
inline void enter_mesh(const SceneView<T>& scene, std::uint32_t i, const SingleRay& local,
                       Walk& walk) {
  const MeshView<T>& mesh = mesh_of(scene, i);
  walk.boxes = bvh_ray(local, mesh.nodes, nullptr);
  walk.triangles = mesh_ray(local, mesh);
  walk.instance = i;
  walk.floor = walk.stack.size;
  visit_node(walk.boxes, 0, walk.t, walk.stack);
}

inline void enter_scene(const SceneView<T>& scene, const SingleRay& ray, Walk& walk) {
  walk.boxes = bvh_ray(ray, scene.nodes, scene.motion);
  walk.instance = kNoHit;
  walk.floor = 0;
}

/// The primitives of a leaf of the scene's tree. At a mesh the rest of the leaf goes back to the
/// stack. Not inlined: nodes and triangles want the registers.
template <bool kShadow>
[[gnu::noinline]] void visit_leaf(const SceneView<T>& scene, const SingleRay& ray,
                                  std::uint32_t leaf, std::int32_t key, Walk& walk) {
  const std::uint32_t end = leaf_first(leaf) + leaf_count(leaf);
  for (std::uint32_t k = leaf_first(leaf); k < end; ++k) {
    const std::uint32_t i = scene.leaves[k];
    if (is_mesh(scene, i)) {
      if (k + 1 < end) {
        walk.stack.key[walk.stack.size] = key;
        walk.stack.child[walk.stack.size++] = BvhNode::kLeaf | (end - k - 1) << 24 | (k + 1);
      }
      enter_mesh(scene, i, to_mesh_space(scene, i, ray), walk);
      return;
    }
    NearestHit h{Real(walk.t), Int(walk.primitive), Int(0U), Real(walk.b1), Real(walk.b2)};
    with_kind(scene, i, [&]<PrimitiveKind kKind>() {
      test_primitive<kShadow, kKind, TestOrder::Any>(scene, i, broadcast_ray(ray), Mask(true), h);
    });
    walk.t = first(h.t);
    walk.b1 = first(h.b1);
    walk.b2 = first(h.b2);
    walk.primitive = first(h.primitive);
    if (kShadow && walk.primitive != kNoHit) return;
  }
}

/// Asks for the memory that the walk will read next.
inline void prefetch(const SceneView<T>& scene, const Walk& walk) {
  if (walk.stack.size == 0) return;
  const std::uint32_t child = walk.stack.child[walk.stack.size - 1];
  const char* at = reinterpret_cast<const char*>(walk.boxes.nodes) + child * sizeof(BvhNode);
  if (is_leaf(child)) {
    at = walk.instance == kNoHit ? reinterpret_cast<const char*>(scene.leaves)
                                 : reinterpret_cast<const char*>(walk.triangles.blocks) +
                                       leaf_first(child) * sizeof(TriangleBlock<T>);
  }
  constexpr std::size_t kBytes =
      sizeof(BvhNode) > sizeof(TriangleBlock<T>) ? sizeof(BvhNode) : sizeof(TriangleBlock<T>);
  for (std::size_t line = 0; line < kBytes; line += 64) __builtin_prefetch(at + line);
}

/// Visits one node or leaf; false when nothing is left to visit.
template <bool kShadow>
bool advance(const SceneView<T>& scene, const RayTable& rays, unsigned lane, Walk& walk) {
  BvhStack& stack = walk.stack;
  const std::int32_t limit = key_limit(walk.t);
  do {
    if (stack.size == walk.floor) {
      if (stack.size == 0) return false;
      enter_scene(scene, rays.single(lane), walk);
    }
    --stack.size;
  } while (stack.key[stack.size] > limit);
  const std::uint32_t child = stack.child[stack.size];
  if (!is_leaf(child)) {
    visit_node(walk.boxes, child, walk.t, stack);
  } else if (walk.instance != kNoHit) {
    hit_block(walk.triangles, leaf_first(child), T(0), walk.t,
              [&](T t, std::uint32_t slot, T b1, T b2) {
                const bool first = walk.instance < walk.primitive ||
                                   (walk.instance == walk.primitive && slot < walk.slot);
                if (!(t < walk.t || (t == walk.t && first))) return;
                walk.t = t;
                walk.b1 = b1;
                walk.b2 = b2;
                walk.primitive = walk.instance;
                walk.slot = slot;
              });
  } else {
    visit_leaf<kShadow>(scene, rays.single(lane), child, stack.key[stack.size], walk);
  }
  if (kShadow && walk.primitive != kNoHit) return false;
  prefetch(scene, walk);
  return true;
}

/// Finds the nearest hits before hit.t; with kShadow any hit will do. Never inlined: within the
/// step of the path tracer it would take the inliner's budget from what is called there once per
/// path.
template <bool kShadow>
[[gnu::noinline]] void find_hits(const SceneView<T>& scene, const Ray& ray, Mask active,
                                 NearestHit& hit) {
  if (!uses(scene, Feature::Tree)) {
    test_all<kShadow>(scene, ray, active, hit);
    return;
  }
  // A single mesh needs no tree over it.
  const bool single_mesh = scene.surface_count == 1 && is_mesh(scene, 0);
  const RayTable rays(single_mesh ? to_mesh_space(scene, 0, ray) : ray);
  alignas(64) T t[kLanes], b1[kLanes], b2[kLanes];
  alignas(64) std::uint32_t primitive[kLanes], slot[kLanes];
  store(t, hit.t);
  store(b1, hit.b1);
  store(b2, hit.b2);
  store(primitive, hit.primitive);
  store(slot, hit.slot);
  Walk walks[kLanes];
  unsigned going[kLanes];
  unsigned count = 0;
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    Walk& walk = walks[lane];
    walk.t = t[lane];
    walk.b1 = b1[lane];
    walk.b2 = b2[lane];
    walk.primitive = primitive[lane];
    walk.slot = slot[lane];
    walk.stack.size = 0;
    if (single_mesh) {
      enter_mesh(scene, 0, rays.single(lane), walk);
    } else {
      enter_scene(scene, rays.single(lane), walk);
      visit_node(walk.boxes, 0, walk.t, walk.stack);
    }
    going[count++] = lane;
  }
  // The rays take turns, so that each one's memory arrives while the others compute.
  while (count > 0) {
    for (unsigned k = 0; k < count;) {
      if (advance<kShadow>(scene, rays, going[k], walks[going[k]])) {
        ++k;
      } else {
        going[k] = going[--count];
      }
    }
  }
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const Walk& walk = walks[lane];
    t[lane] = walk.t;
    b1[lane] = walk.b1;
    b2[lane] = walk.b2;
    primitive[lane] = walk.primitive;
    slot[lane] = walk.slot;
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
