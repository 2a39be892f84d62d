#pragma once
// One ray down an eight-wide BVH, eight boxes at a time.

#include "core/accel/bvh_node.h"
#include "core/accel/single_ray.h"

LIGHTBENCH_KERNEL_BEGIN

/// Visits the leaves that the ray meets before t_max, nearer boxes first; `leaf(child)` returns
/// true to stop. Boxes are widened by rounding error (Ize, JCGT 2:2, 2013), so no hit is missed.
template <class Leaf>
bool walk(const BvhNode* nodes, const BvhMotion* motion, const SingleRay& ray, const T& t_max,
          Leaf leaf) {
  struct Entry {
    std::uint32_t child;
    T near;
  };
  constexpr T kWiden = T(1) + 12 * kEpsilon;
  Entry stack[512];
  int size = 0;
  stack[size++] = {0, T(0)};
  const bool negative[3] = {ray.inverse[0] < 0, ray.inverse[1] < 0, ray.inverse[2] < 0};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.near > t_max * kWiden) continue;
    if (is_leaf(entry.child)) {
      if (leaf(entry.child)) return true;
      continue;
    }
    const BvhNode& node = nodes[entry.child];
    alignas(64) T near_of[kBvhWidth + kLanes];
    std::uint32_t hits = 0;
    for (int k = 0; k < kBvhWidth; k += kLanes) {
      Real near(0), far(t_max);
      for (int a = 0; a < 3; ++a) {
        Real lo = load_of_8(node.lo[a] + k), hi = load_of_8(node.hi[a] + k);
        if (motion != nullptr) {
          const BvhMotion& m = motion[entry.child];
          lo = fma(load_of_8(m.lo[a] + k), Real(ray.time), lo);
          hi = fma(load_of_8(m.hi[a] + k), Real(ray.time), hi);
        }
        const Real first = negative[a] ? hi : lo, last = negative[a] ? lo : hi;
        // 0 * inf is NaN where the ray runs within a box's face: max and min then ignore this axis.
        near = max((first - Real(ray.o[a])) * Real(ray.inverse[a]), near);
        far = min((last - Real(ray.o[a])) * Real(ray.inverse[a]), far);
      }
      store(near_of + k, near);
      hits |= bits(near <= far * kWiden) << k;
    }
    hits &= (1U << kBvhWidth) - 1U;
    // Insertion sort into the stack, farthest first.
    const int base = size;
    for (; hits != 0; hits &= hits - 1) {
      const int k = __builtin_ctz(hits);
      int at = size++;
      while (at > base && stack[at - 1].near < near_of[k]) {
        stack[at] = stack[at - 1];
        --at;
      }
      stack[at] = {node.child[k], near_of[k]};
    }
  }
  return false;
}

LIGHTBENCH_KERNEL_END
