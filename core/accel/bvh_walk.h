#pragma once
// One ray down an eight-wide BVH: eight boxes at a time, nearer ones first. Rays and stacks are
// values that are advanced node by node, so that several rays can take turns: while one waits for
// memory, the others compute.

#include <bit>

#include "core/accel/bvh_node.h"
#include "core/accel/eight.h"
#include "core/accel/single_ray.h"

LIGHTBENCH_KERNEL_BEGIN

/// Nodes and leaves that a ray has yet to visit, the nearest on top if they are sorted. The key of
/// an entry is the distance at which the ray enters its box, as the bits of a float (which order
/// non-negative floats) rounded down, with the number of the child in the last three.
struct BvhStack {
  /// 70 levels of 7 siblings (build_bvh() goes no deeper), for the scene's tree and a mesh's.
  static constexpr int kDepth = 2 * 7 * 70 + 64;
  int size = 0;
  std::int32_t key[kDepth + kBvhWidth];  // written eight at a time
  std::uint32_t child[kDepth + kBvhWidth];
};

/// What the box tests need of up to kRays rays, and which tree each of them walks.
template <int kRays>
struct BvhRays {
  alignas(64) T o[3][kRays], inverse[3][kRays], time[kRays];
  /// Where a node holds the planes met first and last, in floats from its start.
  alignas(64) std::uint32_t near[3][kRays], far[3][kRays];
  /// How far hits still count: of boxes, and as the largest key of an entry.
  alignas(64) T reach[kRays];
  alignas(64) std::uint32_t limit[kRays];
  const BvhNode* nodes[kRays];
  const BvhMotion* motion[kRays];
};

inline constexpr std::uint32_t near_row(unsigned axis, bool negative) {
  return kBvhWidth * (negative ? 3 + axis : axis);
}

template <int kRays>
void set_ray(BvhRays<kRays>& rays, unsigned i, const SingleRay& ray, const BvhNode* nodes,
             const BvhMotion* motion) {
  for (unsigned a = 0; a < 3; ++a) {
    rays.o[a][i] = ray.o[a];
    rays.inverse[a][i] = ray.inverse[a];
    rays.near[a][i] = near_row(a, ray.inverse[a] < 0);
    rays.far[a][i] = near_row(a, !(ray.inverse[a] < 0));
  }
  rays.time[i] = ray.time;
  rays.nodes[i] = nodes;
  rays.motion[i] = motion;
}

/// Boxes are widened by rounding error (Ize, JCGT 2:2, 2013), so no hit is missed.
inline constexpr T kWidenBox = T(1) + 12 * kEpsilon;
/// Keys are float in double kernels too, and the widening of float covers their rounding.
inline constexpr T kWidenKey = T(1) + 12 * T(0x1p-24F);
/// Infinite distances to parallel planes must not compare as within reach.
inline constexpr T kFarthest = T(0x1p126F);

/// Only hits before t count from now on.
template <int kRays>
void set_limit(BvhRays<kRays>& rays, unsigned i, T t) {
  rays.reach[i] = t < kFarthest ? t : kFarthest;
  rays.limit[i] = std::bit_cast<std::uint32_t>(static_cast<float>(t * kWidenKey));
}

/// Distances at which a ray enters kPart of a node's boxes from `column` on, and a bit for each
/// that it meets within its reach.
struct BoxHits {
  Part near;
  std::uint32_t bits;
};

template <int kRays>
BoxHits hit_boxes(const BvhRays<kRays>& rays, unsigned i, std::uint32_t index, unsigned column) {
  const float* rows = rays.nodes[i][index].lo[0] + column;
  Part first[3], last[3];
  for (unsigned a = 0; a < 3; ++a) {
    first[a] = load_part(rows + rays.near[a][i]);
    last[a] = load_part(rows + rays.far[a][i]);
  }
  if (rays.motion[i] != nullptr) {
    const float* moves = rays.motion[i][index].lo[0] + column;
    for (unsigned a = 0; a < 3; ++a) {
      first[a] = fma(load_part(moves + rays.near[a][i]), Part(rays.time[i]), first[a]);
      last[a] = fma(load_part(moves + rays.far[a][i]), Part(rays.time[i]), last[a]);
    }
  }
  Part near(T(0)), far(rays.reach[i]);
  for (unsigned a = 0; a < 3; ++a) {
    // 0 * inf is NaN where the ray runs within a box's face: max and min then ignore this axis.
    near = max((first[a] - Part(rays.o[a][i])) * Part(rays.inverse[a][i]), near);
    far = min((last[a] - Part(rays.o[a][i])) * Part(rays.inverse[a][i]), far);
  }
  return {near, bits(near <= far * Part(kWidenBox))};
}

#if LIGHTBENCH_LANES > 1
#ifndef __AVX512VL__
/// For each mask of eight, the numbers of its set bits, rising, a byte each.
struct SetBits {
  std::uint64_t places[256];
  constexpr SetBits() : places() {
    for (unsigned m = 0; m < 256; ++m) {
      int at = 0;
      for (std::uint64_t i = 0; i < 8; ++i) {
        if ((m >> i & 1U) != 0) places[m] |= i << (8 * at++);
      }
    }
  }
};
inline constexpr SetBits kSetBits;
inline __m256i set_bits_first(std::uint32_t mask) {
  const auto places = static_cast<long long>(kSetBits.places[mask]);
  return _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(places));
}
#endif

/// One layer of a bitonic sorting network: `other` is each key's partner, kMax the places that take
/// the larger of the two.
template <int kMax>
__m256i sort_layer(__m256i key, __m256i other) {
#ifdef __AVX512VL__
  return _mm256_mask_max_epi32(_mm256_min_epi32(key, other), kMax, key, other);
#else
  return _mm256_blend_epi32(_mm256_min_epi32(key, other), _mm256_max_epi32(key, other), kMax);
#endif
}

/// Pushes the children in `hits` (a bit each), `near` being their distances as bits of floats: the
/// first four farthest first, then the others, if any, likewise. Order only saves visits, and to
/// merge the two groups costs more than that (docs/performance.md). No branch depends on the boxes.
inline void push_children(BvhStack& stack, const BvhNode& node, __m256i near, std::uint32_t hits) {
  const __m256i slot = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i none = _mm256_set1_epi32(-1);  // sorted behind the others
  __m256i key = _mm256_or_si256(_mm256_and_si256(near, _mm256_set1_epi32(-8)), slot);
#ifdef __AVX512VL__
  key = _mm256_mask_compress_epi32(none, static_cast<__mmask8>(hits), key);
#else
  const __m256i place = set_bits_first(hits);
  const __m256i count = _mm256_set1_epi32(__builtin_popcount(hits));
  key = _mm256_blendv_epi8(none, _mm256_permutevar8x32_epi32(key, place),
                           _mm256_cmpgt_epi32(count, slot));
#endif
  key = sort_layer<0x99>(key, _mm256_shuffle_epi32(key, 0xb1));
  key = sort_layer<0x33>(key, _mm256_shuffle_epi32(key, 0x4e));
  key = sort_layer<0x55>(key, _mm256_shuffle_epi32(key, 0xb1));
  const __m256i child = _mm256_permutevar8x32_epi32(
      _mm256_loadu_si256(reinterpret_cast<const __m256i*>(node.child)), key);
  const int size = stack.size;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.key + size), key);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.child + size), child);
  stack.size = size + __builtin_popcount(hits);
}

/// The children in `hits`, moved together.
inline __m256i children_in(const BvhNode& node, std::uint32_t hits) {
  const __m256i child = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(node.child));
#ifdef __AVX512VL__
  return _mm256_maskz_compress_epi32(static_cast<__mmask8>(hits), child);
#else
  return _mm256_permutevar8x32_epi32(child, set_bits_first(hits));
#endif
}

/// Pushes the children in `hits` as they come, with keys within any limit.
inline void push_unsorted(BvhStack& stack, const BvhNode& node, std::uint32_t hits) {
  const __m256i child = children_in(node, hits);
  const int size = stack.size;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.key + size), _mm256_setzero_si256());
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(stack.child + size), child);
  stack.size = size + __builtin_popcount(hits);
}
#endif

/// Tests a node's eight boxes and pushes those that ray i meets, the nearest last; with kShadow in
/// any order: sorting would cost more than the nodes that it saves.
template <bool kShadow, int kRays>
void visit_node(const BvhRays<kRays>& rays, unsigned i, std::uint32_t index, BvhStack& stack) {
  const BvhNode& node = rays.nodes[i][index];
#if LIGHTBENCH_LANES == 1
  const int base = stack.size;
  for (unsigned k = 0; k < kBvhWidth; ++k) {
    const BoxHits hit = hit_boxes(rays, i, index, k);
    if (hit.bits == 0) continue;
    const std::int32_t key =
        kShadow ? 0
                : (std::bit_cast<std::int32_t>(static_cast<float>(hit.near)) & ~7) |
                      static_cast<std::int32_t>(k);
    int at = stack.size++;
    for (; at > base && stack.key[at - 1] < key; --at) {
      stack.key[at] = stack.key[at - 1];
      stack.child[at] = stack.child[at - 1];
    }
    stack.key[at] = key;
    stack.child[at] = node.child[k];
  }
#else
#if LIGHTBENCH_LANES == 4
  const BoxHits low = hit_boxes(rays, i, index, 0), high = hit_boxes(rays, i, index, 4);
  const std::uint32_t hits = low.bits | high.bits << 4;
  const __m256 near = _mm256_set_m128(_mm256_cvtpd_ps(high.near.v), _mm256_cvtpd_ps(low.near.v));
#else
  const BoxHits hit = hit_boxes(rays, i, index, 0);
  const std::uint32_t hits = hit.bits;
#ifdef LIGHTBENCH_DOUBLE
  const __m256 near = _mm512_cvtpd_ps(hit.near.v);
#else
  const __m256 near = hit.near.v;
#endif
#endif
  if constexpr (kShadow) {
    push_unsorted(stack, node, hits);
  } else {
    push_children(stack, node, _mm256_castps_si256(near), hits);
  }
#endif
}

/// Entries that end a walk, or its part in a mesh: no leaf is empty. They lie below all others,
/// with a key that is within any limit.
inline constexpr std::uint32_t kDone = BvhNode::kLeaf, kLeaveMesh = BvhNode::kLeaf | 1U;

inline void push(BvhStack& stack, std::int32_t key, std::uint32_t child) {
  stack.key[stack.size] = key;
  stack.child[stack.size++] = child;
}

/// Takes the nearest entry within the limit off the stack.
inline std::uint32_t pop(BvhStack& stack, std::uint32_t limit) {
  int size = stack.size;
  do --size;
  while (stack.key[size] > static_cast<std::int32_t>(limit));
  stack.size = size;
  return stack.child[size];
}

LIGHTBENCH_KERNEL_END
