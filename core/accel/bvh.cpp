#include "core/accel/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/accel/bvh_binary.h"
#include "core/error.h"
#include "core/parallel.h"

namespace lightbench {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

void grow(BvhBox& a, const BvhBox& b) {
  for (int k = 0; k < 3; ++k) {
    a.lo[k] = std::min(a.lo[k], b.lo[k]);
    a.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
}

/// Which binary nodes become wide ones and which are opened into their parents' slots: the choice
/// of least expected cost, found from the leaves up (the recurrence of Ylitie, Karras, Laine, HPG
/// 2017, with leaves given).
class Collapse {
 public:
  Collapse(const BinaryTree& tree, BvhLeaf leaf) : tree_(tree), cost_(tree.nodes.size()) {
    left_slots_.resize(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      const BinaryNode& n = tree.nodes[i];
      const float area = half_area(n.box);
      if (n.is_leaf()) {
        cost_[i].fill(area * leaf_cost(leaf, n.count));
        continue;
      }
      Costs& cost = cost_[i];
      Slots& slots = left_slots_[i];
      for (std::size_t s = kBvhWidth; s >= 2; --s) {
        cost[s - 1] = kInf;
        for (std::size_t k = 1; k < s; ++k) {
          const float c = cost_of(n.left, k) + cost_of(n.right, s - k);
          if (!(c < cost[s - 1])) continue;
          cost[s - 1] = c;
          slots[s - 1] = static_cast<std::uint8_t>(k);
        }
      }
      slots[0] = slots[kBvhWidth - 1];
      cost[0] = area + cost[kBvhWidth - 1];
      for (std::size_t s = 2; s <= kBvhWidth; ++s) {
        if (cost[s - 1] < cost[0]) continue;
        cost[s - 1] = cost[0];
        slots[s - 1] = 0;
      }
    }
  }

  /// The binary nodes that fill the slots of the wide node made of i.
  struct Children {
    std::array<int, kBvhWidth> node;
    int count = 0;
  };
  [[nodiscard]] Children children(int i) const {
    Children c{};
    const BinaryNode& n = tree_.nodes[index(i)];
    if (n.is_leaf()) {
      c.node[0] = i;
      c.count = 1;
      return c;
    }
    const std::size_t left = left_slots_[index(i)][0];
    collect(n.left, left, c);
    collect(n.right, kBvhWidth - left, c);
    return c;
  }

 private:
  // By the number of slots, less 1, that a node and what is below may take of its parent.
  using Costs = std::array<float, kBvhWidth>;
  using Slots = std::array<std::uint8_t, kBvhWidth>;  ///< for the left child; 0: the node stays one

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] float cost_of(int i, std::size_t slots) const { return cost_[index(i)][slots - 1]; }

  void collect(int i, std::size_t slots, Children& c) const {
    const BinaryNode& n = tree_.nodes[index(i)];
    const std::size_t left = slots > 1 && !n.is_leaf() ? left_slots_[index(i)][slots - 1] : 0;
    if (left == 0) {
      c.node[index(c.count++)] = i;
      return;
    }
    collect(n.left, left, c);
    collect(n.right, slots - left, c);
  }

  const BinaryTree& tree_;
  std::vector<Costs> cost_;
  std::vector<Slots> left_slots_;
};

/// Writes the wide tree.
class Writer {
 public:
  Writer(const BinaryTree& tree, const Collapse& collapse, std::span<const BvhBox> start,
         std::span<const BvhBox> end, BvhLeaf leaf)
      : tree_(tree), collapse_(collapse), leaf_(leaf), moving_(!end.empty()) {
    if (moving_) {
      measure(start, start_);
      measure(end, end_);
    }
  }

  Bvh write() {
    add_node();
    fill(0, 0);
    return std::move(result_);
  }

 private:
  /// Bounds of each binary node by those of its items.
  void measure(std::span<const BvhBox> boxes, std::vector<BvhBox>& of_node) const {
    of_node.assign(tree_.nodes.size(), {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}});
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
      const BinaryNode& n = tree_.nodes[i];
      if (n.is_leaf()) {
        for (std::uint32_t k = n.first; k < n.first + n.count; ++k) {
          grow(of_node[i], boxes[tree_.items[k]]);
        }
      } else {
        grow(of_node[i], of_node[static_cast<std::size_t>(n.left)]);
        grow(of_node[i], of_node[static_cast<std::size_t>(n.right)]);
      }
    }
  }

  std::uint32_t add_node() {
    BvhNode node{};
    for (int a = 0; a < 3; ++a) {
      std::fill(std::begin(node.lo[a]), std::end(node.lo[a]), kInf);
      std::fill(std::begin(node.hi[a]), std::end(node.hi[a]), -kInf);
    }
    result_.nodes.push_back(node);
    if (moving_) result_.motion.push_back({});
    return static_cast<std::uint32_t>(result_.nodes.size() - 1);
  }

  std::uint32_t make_leaf(const BinaryNode& n) {
    const bool blocks = leaf_ == BvhLeaf::Blocks;
    const std::size_t first = result_.items.size() / (blocks ? kBvhWidth : 1);
    if (first >= (1U << 24)) {
      throw Error(
          ErrorKind::Scene,
          "scene: too many primitives for one acceleration structure (limit 16.7 million leaves)");
    }
    const auto from = tree_.items.begin() + n.first;
    result_.items.insert(result_.items.end(), from, from + n.count);
    while (blocks && result_.items.size() % kBvhWidth != 0) {
      result_.items.push_back(Bvh::kPadding);
    }
    return BvhNode::kLeaf | (blocks ? 1 : n.count) << 24 | static_cast<std::uint32_t>(first);
  }

  void put_box(std::size_t at, std::size_t slot, std::size_t binary) {
    BvhNode& target = result_.nodes[at];
    const BvhBox& start = moving_ ? start_[binary] : tree_.nodes[binary].box;
    for (int a = 0; a < 3; ++a) {
      target.lo[a][slot] = start.lo[a];
      target.hi[a][slot] = start.hi[a];
      if (!moving_) continue;
      const BvhBox& end = end_[binary];
      // lo + time * (end - start), evaluated in float: one ulp of the larger end covers the
      // rounding.
      const float slack = 4e-7F * std::max(std::max(std::fabs(start.lo[a]), std::fabs(start.hi[a])),
                                           std::max(std::fabs(end.lo[a]), std::fabs(end.hi[a])));
      target.lo[a][slot] -= slack;
      target.hi[a][slot] += slack;
      result_.motion[at].lo[a][slot] = end.lo[a] - start.lo[a];
      result_.motion[at].hi[a][slot] = end.hi[a] - start.hi[a];
    }
  }

  /// Fills wide node `at` from binary node `root`, then its children.
  void fill(int root, std::size_t at) {
    const Collapse::Children children = collapse_.children(root);
    std::array<std::uint32_t, kBvhWidth> wide{};
    for (int i = 0; i < children.count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const auto binary = static_cast<std::size_t>(children.node[slot]);
      put_box(at, slot, binary);
      const BinaryNode& n = tree_.nodes[binary];
      wide[slot] = n.is_leaf() ? 0 : add_node();
      result_.nodes[at].child[slot] = n.is_leaf() ? make_leaf(n) : wide[slot];
    }
    for (int i = 0; i < children.count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if (wide[slot] > 0) fill(children.node[slot], wide[slot]);
    }
  }

  const BinaryTree& tree_;
  const Collapse& collapse_;
  BvhLeaf leaf_;
  bool moving_;
  std::vector<BvhBox> start_, end_;  ///< of each binary node, if anything moves
  Bvh result_;
};

}  // namespace

BvhBox outward_box(const double (&lo)[3], const double (&hi)[3]) {
  BvhBox box{};
  for (int k = 0; k < 3; ++k) {
    const auto l = static_cast<float>(lo[k]), h = static_cast<float>(hi[k]);
    box.lo[k] = static_cast<double>(l) > lo[k] ? std::nextafter(l, -kInf) : l;
    box.hi[k] = static_cast<double>(h) < hi[k] ? std::nextafter(h, kInf) : h;
  }
  return box;
}

Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf,
              Team& team) {
  if (boxes.empty()) {
    Bvh empty;
    empty.nodes.push_back({});
    for (int a = 0; a < 3; ++a) {
      std::fill(std::begin(empty.nodes[0].lo[a]), std::end(empty.nodes[0].lo[a]), kInf);
      std::fill(std::begin(empty.nodes[0].hi[a]), std::end(empty.nodes[0].hi[a]), -kInf);
    }
    if (!boxes_end.empty()) empty.motion.push_back({});
    return empty;
  }
  std::vector<BvhBox> whole(boxes_end.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    whole[i] = boxes[i];
    grow(whole[i], boxes_end[i]);
  }
  const BinaryTree tree =
      build_binary_tree(boxes_end.empty() ? boxes : std::span<const BvhBox>(whole), leaf, team);
  const Collapse collapse(tree, leaf);
  return Writer(tree, collapse, boxes, boxes_end, leaf).write();
}

Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf) {
  Team alone(1);
  return build_bvh(boxes, boxes_end, leaf, alone);
}

}  // namespace lightbench
