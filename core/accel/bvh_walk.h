#pragma once
// One ray down an eight-wide BVH: eight boxes at a time, nearer ones first. A walk is a value that
// is advanced node by node, so that several rays can take turns: while one waits for memory, the
// others compute.

#include <bit>

#include "core/accel/bvh_node.h"
#include "core/accel/eight.h"
#include "core/accel/single_ray.h"

LIGHTBENCH_KERNEL_BEGIN

/// Nodes and leaves that a ray has yet to visit, the nearest on top. The key of an entry is the
/// distance at which the ray enters its box, as the bits of a float (which order non-negative
/// floats) rounded down, with the number of the child in the last three.
struct BvhStack {
  /// 70 levels of 7 siblings (build_bvh() goes no deeper), for the scene's tree and a mesh's.
  static constexpr int kDepth = 2 * 7 * 70 + 64;
  int size = 0;
  std::int32_t key[kDepth + kBvhWidth];  // written eight at a time
  std::uint32_t child[kDepth + kBvhWidth];
};

/// What the box tests need of a ray, and which tree it walks.
struct BvhRay {
  T o[3], inverse[3];
  T time;
  unsigned near_row[3], far_row[3];  ///< where a node holds the planes met first and last
  const BvhNode* nodes;
  const BvhMotion* motion;
};

inline BvhRay bvh_ray(const SingleRay& ray, const BvhNode* nodes, const BvhMotion* motion) {
  BvhRay r;
  for (unsigned a = 0; a < 3; ++a) {
    r.o[a] = ray.o[a];
    r.inverse[a] = ray.inverse[a];
    r.near_row[a] = ray.inverse[a] < 0 ? 3 + a : a;
    r.far_row[a] = ray.inverse[a] < 0 ? a : 3 + a;
  }
  r.time = ray.time;
  r.nodes = nodes;
  r.motion = motion;
  return r;
}

/// Boxes are widened by rounding error (Ize, JCGT 2:2, 2013), so no hit is missed.
inline constexpr T kWidenBox = T(1) + 12 * kEpsilon;

/// The largest key of a box that may hold a hit before t. Keys are float in double kernels too, and
/// the widening of float covers their rounding.
inline std::int32_t key_limit(T t) {
  constexpr float kWidenKey = 1 + 12 * 0x1p-24F;
  return std::bit_cast<std::int32_t>(static_cast<float>(t) * kWidenKey);
}

/// Distances at which the ray enters kPart of a node's boxes from `column` on, and a bit for each
/// that it meets before t_max.
struct BoxHits {
  Part near;
  std::uint32_t bits;
};

inline BoxHits hit_boxes(const BvhRay& ray, std::uint32_t index, unsigned column, T t_max) {
  // Infinite distances to parallel planes must not compare as within reach.
  constexpr T kFarthest = T(0x1p126F);
  const float* rows = ray.nodes[index].lo[0] + column;
  Part near(T(0)), far(t_max < kFarthest ? t_max : kFarthest);
  for (unsigned a = 0; a < 3; ++a) {
    Part first = load_part(rows + kBvhWidth * ray.near_row[a]);
    Part last = load_part(rows + kBvhWidth * ray.far_row[a]);
    if (ray.motion != nullptr) {
      const float* moves = ray.motion[index].lo[0] + column;
      first = fma(load_part(moves + kBvhWidth * ray.near_row[a]), Part(ray.time), first);
      last = fma(load_part(moves + kBvhWidth * ray.far_row[a]), Part(ray.time), last);
    }
    // 0 * inf is NaN where the ray runs within a box's face: max and min then ignore this axis.
    near = max((first - Part(ray.o[a])) * Part(ray.inverse[a]), near);
    far = min((last - Part(ray.o[a])) * Part(ray.inverse[a]), far);
  }
  return {near, bits(near <= far * Part(kWidenBox))};
}

#if LIGHTBENCH_LANES > 1
/// One layer of a bitonic sorting network: `other` is each key's partner, kMax the places that take
/// the larger of the two.
template <int kMax>
__m256i sort_layer(__m256i key, __m256i other) {
  return _mm256_blend_epi32(_mm256_min_epi32(key, other), _mm256_max_epi32(key, other), kMax);
}

/// Pushes the children in `hits` (a bit each), farthest first, `near` being their distances as bits
/// of floats. No branch depends on the boxes.
inline void push_children(BvhStack& stack, const BvhNode& node, __m256i near, std::uint32_t hits) {
  const __m256i slot = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i lane_bit = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
  const __m256i hit = _mm256_cmpeq_epi32(
      _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(hits)), lane_bit), lane_bit);
  __m256i key = _mm256_or_si256(_mm256_and_si256(near, _mm256_set1_epi32(-8)), slot);
  key = _mm256_or_si256(key, _mm256_xor_si256(hit, _mm256_set1_epi32(-1)));  // the others last
  key = sort_layer<0x99>(key, _mm256_shuffle_epi32(key, 0xb1));
  key = sort_layer<0xc3>(key, _mm256_shuffle_epi32(key, 0x4e));
  key = sort_layer<0xa5>(key, _mm256_shuffle_epi32(key, 0xb1));
  key = sort_layer<0x0f>(key, _mm256_permute2x128_si256(key, key, 1));
  key = sort_layer<0x33>(key, _mm256_shuffle_epi32(key, 0x4e));
  key = sort_layer<0x55>(key, _mm256_shuffle_epi32(key, 0xb1));
  const __m256i child = _mm256_permutevar8x32_epi32(
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(node.child)), key);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.key + stack.size), key);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.child + stack.size), child);
  stack.size += __builtin_popcount(hits);
}
#endif

/// Tests a node's eight boxes and pushes those that the ray meets before t_max.
inline void visit_node(const BvhRay& ray, std::uint32_t index, T t_max, BvhStack& stack) {
  const BvhNode& node = ray.nodes[index];
#if LIGHTBENCH_LANES == 1
  const int base = stack.size;
  for (unsigned k = 0; k < kBvhWidth; ++k) {
    const BoxHits hit = hit_boxes(ray, index, k, t_max);
    if (hit.bits == 0) continue;
    const std::int32_t key = (std::bit_cast<std::int32_t>(static_cast<float>(hit.near)) & ~7) |
                             static_cast<std::int32_t>(k);
    int at = stack.size++;
    for (; at > base && stack.key[at - 1] < key; --at) {
      stack.key[at] = stack.key[at - 1];
      stack.child[at] = stack.child[at - 1];
    }
    stack.key[at] = key;
    stack.child[at] = node.child[k];
  }
#elif LIGHTBENCH_LANES == 4
  const BoxHits low = hit_boxes(ray, index, 0, t_max), high = hit_boxes(ray, index, 4, t_max);
  const __m256 near = _mm256_set_m128(_mm256_cvtpd_ps(high.near.v), _mm256_cvtpd_ps(low.near.v));
  push_children(stack, node, _mm256_castps_si256(near), low.bits | high.bits << 4);
#else
  const BoxHits hit = hit_boxes(ray, index, 0, t_max);
#ifdef LIGHTBENCH_DOUBLE
  const __m256 near = _mm512_cvtpd_ps(hit.near.v);
#else
  const __m256 near = hit.near.v;
#endif
  push_children(stack, node, _mm256_castps_si256(near), hit.bits);
#endif
}

LIGHTBENCH_KERNEL_END
