#pragma once
// Boxes, eight-wide BVH nodes and the triangle blocks of their leaves, shared by the builder
// (core/accel) and the kernels. Bounds are float, rounded outward from double, whatever number type
// the kernel has.

#include <cstddef>
#include <cstdint>

namespace lightbench {

/// Float box that contains a double one (rounded outward).
struct BvhBox {
  float lo[3];
  float hi[3];
};

inline constexpr int kBvhWidth = 8;

/// child[i]: index of an inner node, or a leaf: kLeaf | count << 24 | first, with `first` < 2^24
/// leaf items (a triangle block or an index into the primitive list) and 1 <= count <= 127. An
/// unused slot has bounds that no ray meets (lo = +inf, hi = -inf). Aligned so that no row of eight
/// floats lies across two cache lines, here and below.
struct alignas(32) BvhNode {
  static constexpr std::uint32_t kLeaf = 0x80000000U;
  float lo[3][kBvhWidth];
  float hi[3][kBvhWidth];
  std::uint32_t child[kBvhWidth];
};
constexpr bool is_leaf(std::uint32_t child) { return (child & BvhNode::kLeaf) != 0; }
constexpr std::uint32_t leaf_first(std::uint32_t child) { return child & 0x00ffffffU; }
constexpr std::uint32_t leaf_count(std::uint32_t child) { return (child >> 24) & 0x7fU; }

/// Trees of more bytes are fetched ahead of their visit. Second-level caches hold 0.5 to 2 MiB; in
/// trees that fit, asking costs rays a quarter of their speed (docs/performance.md).
inline constexpr std::size_t kCacheBytes = std::size_t{2} << 20;

/// How far the bounds of a node's children move from time 0 to time 1 (motion is linear, so bounds
/// interpolated between the two ends contain the shape at every time).
struct alignas(32) BvhMotion {
  float lo[3][kBvhWidth];
  float hi[3][kBvhWidth];
};

/// Eight triangles, vertex-major: v[3 * vertex + axis][slot]. Unused slots hold a triangle that no
/// ray meets (all vertices equal).
template <class T>
struct alignas(32) TriangleBlock {
  T v[9][kBvhWidth];
};

}  // namespace lightbench
