#pragma once
// The lanes' rays through the scene's tree and those of its meshes. Nodes and triangles: one ray at
// a time against eight boxes or eight triangles, the rays taking turns. The other primitives: each
// ray that has come to one waits for the rest, then all are tested at once, every lane its own.

#include "core/accel/mesh_hit.h"
#include "core/accel/primitive_hit.h"
#include "core/kernel/uses.h"

LIGHTBENCH_KERNEL_BEGIN

inline bool is_mesh(const SceneView<T>& scene, std::uint32_t i) {
  return scene.kind[i] == static_cast<std::uint32_t>(PrimitiveKind::Mesh);
}

/// Where nodes or what their leaves hold lie. Of nodes as of leaves there are fewer than 2^24.
struct Memory {
  const char* base;
  std::size_t stride;
};
template <class Item>
Memory memory_of(const Item* items) {
  return {reinterpret_cast<const char*>(items), sizeof(Item)};
}

/// The lanes' rays on their way, and the nearest hits so far.
struct Walks {
  BvhRays<kLanes> boxes;
  alignas(64) T t[kLanes], b1[kLanes], b2[kLanes];
  alignas(64) std::uint32_t primitive[kLanes], slot[kLanes];
  /// The entry of its stack that each has taken to visit next.
  alignas(64) std::uint32_t key[kLanes], next[kLanes];
  std::uint32_t instance[kLanes];  ///< the mesh in whose tree it is, kNoHit: the scene's
  bool beyond_cache[kLanes];       ///< that tree is
  Memory memory[kLanes][2];        ///< its nodes and leaves; asked for ahead if it is
  MeshRay triangles[kLanes];
  BvhStack stack[kLanes];
};

/// Asks for the memory that a lane will read next: no branch, as in take_next(). Inlined by force:
/// g++ takes a function that only prefetches for one without effect and drops its calls.
[[gnu::always_inline]] inline void prefetch(const Walks& w, unsigned lane) {
  const std::uint32_t child = w.next[lane];
  const Memory& memory = w.memory[lane][child >> 31];
  const char* at = memory.base + std::size_t{leaf_first(child)} * memory.stride;
  constexpr std::size_t kBytes =
      sizeof(BvhNode) > sizeof(TriangleBlock<T>) ? sizeof(BvhNode) : sizeof(TriangleBlock<T>);
  for (std::size_t line = 0; line < kBytes; line += 64) __builtin_prefetch(at + line);
}

/// Takes the next entry off the lane's stack; returns the lane's bit if that is a node within the
/// limit. No branch depends on it: it would be guessed wrong too often, at the price of several
/// visits.
inline std::uint32_t take_next(Walks& w, unsigned lane) {
  BvhStack& stack = w.stack[lane];
  const int top = --stack.size;
  const auto key = static_cast<std::uint32_t>(stack.key[top]);
  const std::uint32_t child = stack.child[top];
  w.key[lane] = key;
  w.next[lane] = child;
  if (w.beyond_cache[lane]) prefetch(w, lane);
  return (static_cast<std::uint32_t>(key <= w.boxes.limit[lane]) & ~(child >> 31)) << lane;
}

template <bool kShadow>
std::uint32_t visit(Walks& w, unsigned lane, std::uint32_t node) {
  visit_node<kShadow>(w.boxes, lane, node, w.stack[lane]);
  return take_next(w, lane);
}

/// `local` is the ray in the space of mesh instance i.
template <bool kShadow>
void enter_mesh(const SceneView<T>& scene, std::uint32_t i, const SingleRay& local, Walks& w,
                unsigned lane) {
  const MeshView<T>& mesh = mesh_of(scene, i);
  set_ray(w.boxes, lane, local, mesh.nodes, nullptr);
  w.triangles[lane] = mesh_ray(local, mesh);
  w.instance[lane] = i;
  w.beyond_cache[lane] = mesh.beyond_cache;
  w.memory[lane][0] = memory_of(mesh.nodes);
  w.memory[lane][1] = memory_of(mesh.blocks);
  visit<kShadow>(w, lane, 0);
}

/// What all lanes in the scene's tree have in common.
inline void set_scene(const SceneView<T>& scene, Walks& w, unsigned lane) {
  w.boxes.nodes[lane] = scene.nodes;
  w.boxes.motion[lane] = scene.motion;
  w.instance[lane] = kNoHit;
  w.beyond_cache[lane] = scene.beyond_cache;
  w.memory[lane][0] = memory_of(scene.nodes);
  w.memory[lane][1] = memory_of(scene.leaves);
}

inline void leave_mesh(const SceneView<T>& scene, const RayTable& rays, Walks& w, unsigned lane) {
  set_ray(w.boxes, lane, rays.single(lane), scene.nodes, scene.motion);
  set_scene(scene, w, lane);
  take_next(w, lane);
}

/// The block of triangles that comes next. A hit ends the walk if any will do.
template <bool kShadow>
void visit_block(Walks& w, unsigned lane) {
  const std::uint32_t instance = w.instance[lane];
  hit_block(w.triangles[lane], leaf_first(w.next[lane]), T(0), w.t[lane],
            [&](T t, std::uint32_t slot, T b1, T b2) {
              const bool first = instance < w.primitive[lane] ||
                                 (instance == w.primitive[lane] && slot < w.slot[lane]);
              if (!(t < w.t[lane] || (t == w.t[lane] && first))) return;
              w.t[lane] = t;
              w.b1[lane] = b1;
              w.b2[lane] = b2;
              w.primitive[lane] = instance;
              w.slot[lane] = slot;
            });
  if (kShadow && w.primitive[lane] != kNoHit) {
    w.key[lane] = 0;
    w.next[lane] = kDone;
    return;
  }
  set_limit(w.boxes, lane, w.t[lane]);
  take_next(w, lane);
}

/// Only hits before hit.t count from now on.
inline void set_limits(Walks& w, Real t) {
  store(w.boxes.reach, min(t, Real(kFarthest)));
  store(w.boxes.limit, float_bits(t * Real(kWidenKey)));
}

/// The next primitive of the leaf that each waiting lane has come to; meshes are entered.
template <bool kShadow>
void visit_items(const SceneView<T>& scene, const RayTable& rays, const Ray& ray, Mask waiting,
                 Walks& w) {
  const Int next = load(w.next);
  const Int id = gather(scene.leaves, select(waiting, next & Int(0x00ffffffU), Int(0U)));
  NearestHit hit{load(w.t), load(w.primitive), load(w.slot), load(w.b1), load(w.b2)};
  std::uint32_t meshes = 0;
  for_each_kind(scene, id, waiting, [&]<PrimitiveKind kKind>(Mask m) {
    if constexpr (kKind == PrimitiveKind::Mesh) {
      meshes = bits(m);
    } else {
      // The other lanes read from the first row on: there are as many numbers as one row has.
      const GatheredRow row{scene.rows, select(m, row_offsets<kKind>(scene, id), Int(0U))};
      const auto shape = shape_at<kKind>(row, ray.time, scene.camera.moving);
      test_shape<kShadow, kKind, TestOrder::Any>(id, shape, ray, hit_quality(scene), m, hit);
    }
  });
  store(w.t, hit.t);
  store(w.primitive, hit.primitive);
  store(w.b1, hit.b1);
  store(w.b2, hit.b2);
  set_limits(w, hit.t);
  const Int rest = next + Int(1U - (1U << 24));  // the leaf without its first item
  const Mask more = (rest & Int(0x7f000000U)) != Int(0U);
  const Mask found = Mask(kShadow) && hit.primitive != Int(kNoHit);
  store(w.key, select(waiting, Int(0U), load(w.key)));
  store(w.next, select(waiting, select(found, Int(kDone), rest), next));
  if (meshes != 0) {
    alignas(64) std::uint32_t ids[kLanes], left[kLanes];
    store(ids, id);
    store(left, rest);
    for (std::uint32_t m = meshes; m != 0; m &= m - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(m));
      BvhStack& stack = w.stack[lane];
      if (leaf_count(left[lane]) > 0) push(stack, stack.key[stack.size], left[lane]);
      push(stack, 0, kLeaveMesh);
      const SingleRay local = to_mesh_space(scene, ids[lane], rays.single(lane));
      enter_mesh<kShadow>(scene, ids[lane], local, w, lane);
    }
  }
  for (std::uint32_t m = bits(waiting && !more && !found) & ~meshes; m != 0; m &= m - 1) {
    take_next(w, static_cast<unsigned>(__builtin_ctz(m)));
  }
}

/// Sets the rays out at the roots.
template <bool kShadow>
void start_walks(const SceneView<T>& scene, const RayTable& rays, bool single_mesh, Mask active,
                 const NearestHit& hit, Walks& w) {
  store(w.t, hit.t);
  store(w.b1, hit.b1);
  store(w.b2, hit.b2);
  store(w.primitive, hit.primitive);
  store(w.slot, hit.slot);
  set_limits(w, hit.t);
  for (unsigned a = 0; a < 3; ++a) {
    const Real inverse = load(rays.inverse[a]);
    store(w.boxes.o[a], load(rays.o[a]));
    store(w.boxes.inverse[a], inverse);
    const Mask negative = inverse < Real(0);
    store(w.boxes.near[a], select(negative, Int(near_row(a, true)), Int(near_row(a, false))));
    store(w.boxes.far[a], select(negative, Int(near_row(a, false)), Int(near_row(a, true))));
  }
  store(w.boxes.time, load(rays.time));
  store(w.key, Int(0U));
  store(w.next, Int(kDone));
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    w.stack[lane].size = 0;
    push(w.stack[lane], 0, kDone);
    if (single_mesh) {
      enter_mesh<kShadow>(scene, 0, rays.single(lane), w, lane);
      continue;
    }
    set_scene(scene, w, lane);
    visit<kShadow>(w, lane, 0);
  }
}

/// Visits nodes until no lane in `lanes` (a bit each) has one to visit next. The lanes take turns,
/// half of them at a time: what one half does next is known while the other computes.
template <bool kShadow>
void visit_nodes(Walks& w, std::uint32_t lanes) {
  constexpr std::uint32_t kHalf = (1U << (kLanes / 2)) - 1;
  std::uint32_t half = lanes & kHalf, other = lanes & ~kHalf;
  while ((half | other) != 0) {
    std::uint32_t again = 0;
    for (std::uint32_t m = half; m != 0; m &= m - 1) {
      const auto lane = static_cast<unsigned>(__builtin_ctz(m));
      again |= visit<kShadow>(w, lane, w.next[lane]);
    }
    half = other;
    other = again;
  }
}

/// The surfaces that the tree does without, against all lanes.
template <bool kShadow>
[[gnu::noinline]] void test_wide(const SceneView<T>& scene, const Ray& ray, Mask active,
                                 NearestHit& hit) {
  for (std::uint32_t i = 0; i < scene.wide_count; ++i) {
    with_kind(scene, scene.wide[i], [&]<PrimitiveKind kKind>() {
      test_primitive<kShadow, kKind, TestOrder::Any>(scene, scene.wide[i], ray, active, hit);
    });
  }
}

/// Nearest hits before hit.t, or any.
template <bool kShadow>
void walk_trees(const SceneView<T>& scene, const Ray& ray, Mask active, NearestHit& hit) {
  // A single mesh needs no tree over it.
  const bool single_mesh = scene.surface_count == 1 && is_mesh(scene, 0);
  if (scene.wide_count > 0) {
    test_wide<kShadow>(scene, ray, active, hit);
    if (kShadow) active = active && hit.primitive == Int(kNoHit);
    if (none(active)) return;
  }
  const RayTable rays(single_mesh ? to_mesh_space(scene, 0, ray) : ray);
  Walks w;
  start_walks<kShadow>(scene, rays, single_mesh, active, hit, w);
  for (;;) {
    // What lies behind hits found since is passed over.
    std::uint32_t stale = bits(load(w.key) > load(w.boxes.limit));
    if (stale != 0) {
      for (; stale != 0; stale &= stale - 1) {
        take_next(w, static_cast<unsigned>(__builtin_ctz(stale)));
      }
      continue;
    }
    const Int next = load(w.next);
    const std::uint32_t nodes = bits(next < Int(BvhNode::kLeaf));
    visit_nodes<kShadow>(w, nodes);
    std::uint32_t waiting = bits(next > Int(kDone));
    std::uint32_t busy = nodes;
    if (uses(scene, Feature::Meshes)) {
      for (std::uint32_t m = waiting; m != 0; m &= m - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(m));
        if (w.next[lane] == kLeaveMesh) {
          leave_mesh(scene, rays, w, lane);
        } else if (w.instance[lane] != kNoHit) {
          visit_block<kShadow>(w, lane);
        } else {
          continue;
        }
        busy |= 1U << lane;
      }
      waiting &= ~busy;
    }
    if (busy != 0) continue;
    if (waiting == 0) break;
    visit_items<kShadow>(scene, rays, ray, mask_from_bits(waiting), w);
  }
  hit = {load(w.t), load(w.primitive), load(w.slot), load(w.b1), load(w.b2)};
}

LIGHTBENCH_KERNEL_END
