#pragma once
// The bounding volume hierarchy as a value: built from boxes, it knows no shapes. Binned SAH on a
// binary tree (bvh_binary.h), then collapsed to eight children per node at the least expected cost.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/accel/bvh_node.h"

namespace lightbench {

class Team;

/// Until `a` holds b too.
inline void grow(BvhBox& a, const BvhBox& b) {
  for (int k = 0; k < 3; ++k) {
    a.lo[k] = std::min(a.lo[k], b.lo[k]);
    a.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
}
/// Half the surface of a box; 0 for the empty one.
inline float half_area(const BvhBox& b) {
  const float x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1], z = b.hi[2] - b.lo[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}
BvhBox outward_box(const double (&lo)[3], const double (&hi)[3]);

/// What a leaf holds: single items (each tested alone), or blocks of eight tested at once.
enum class BvhLeaf { Items, Blocks };

/// `items` lists the boxes' indices in leaf order. With BvhLeaf::Blocks every leaf is one block of
/// eight entries, padded with kPadding, and a leaf's `first` is its block number. Children come
/// after their parents.
struct Bvh {
  static constexpr std::uint32_t kPadding = 0xffffffffU;
  std::vector<BvhNode> nodes;
  std::vector<BvhMotion> motion;  ///< empty unless boxes at the end of the shutter were given
  std::vector<std::uint32_t> items;
};

/// Boxes at time 0 and, if anything moves, at time 1 (else empty). Fewer than 2^24 leaves; throws
/// Error{Scene} beyond. No boxes give one node that no ray meets. The
/// tree is the same for any number of threads.
Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf,
              Team& team);
/// On this thread alone.
Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf);

/// Nodes that a ray through the root's box is expected to visit, and tests it is expected to make
/// in leaves (surface area heuristic), over the whole shutter. 0 if that box has no surface.
float expected_cost(const Bvh& bvh, BvhLeaf leaf);

/// Fits the bounds to boxes that have moved or changed, as many as the tree was built of. Which
/// boxes share a node stays as it was, so the farther they move, the more a ray has to visit;
/// expected_cost() says how much.
void refit_bvh(Bvh& bvh, std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end,
               BvhLeaf leaf);

}  // namespace lightbench
