#pragma once
// The binary tree from which build_bvh() makes its wide nodes: binned SAH (Wald 2007) in parallel.
// The tree does not depend on the number of threads: how a range of boxes is split follows from the
// boxes and their order alone, and partitions keep the order.

#include <cstdint>
#include <span>
#include <vector>

#include "core/accel/bvh.h"
#include "core/parallel.h"

namespace lightbench {

struct BinaryNode {
  BvhBox box;  ///< over the whole shutter
  std::uint32_t first, count;
  int left, right;  ///< indices of the children; negative in leaves
  [[nodiscard]] bool is_leaf() const { return left < 0; }
};

struct BinaryTree {
  std::vector<BinaryNode> nodes;     ///< the root first, children after their parents
  std::vector<std::uint32_t> items;  ///< indices of boxes; a leaf's are [first, first + count)
};

/// What a leaf of n items costs, against 1 for a node. Single items: measured
/// (docs/performance.md).
inline float leaf_cost(BvhLeaf leaf, std::uint32_t n) {
  if (leaf == BvhLeaf::Items) return 1.25F * static_cast<float>(n);
  const std::uint32_t blocks = (n + kBvhWidth - 1) / kBvhWidth;
  return static_cast<float>(blocks);
}

/// `boxes` must not be empty.
BinaryTree build_binary_tree(std::span<const BvhBox> boxes, BvhLeaf leaf, Team& team);

}  // namespace lightbench
