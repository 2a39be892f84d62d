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

constexpr BvhBox kNowhere = {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};

/// No child of it is met by a ray.
BvhNode unused_node() {
  BvhNode node{};
  for (int a = 0; a < 3; ++a) {
    std::fill(std::begin(node.lo[a]), std::end(node.lo[a]), kInf);
    std::fill(std::begin(node.hi[a]), std::end(node.hi[a]), -kInf);
  }
  return node;
}

/// True if slot `slot` of the node holds a child; whatever its bounds, which may not be set yet.
bool is_used(const BvhNode& node, std::size_t slot) { return node.child[slot] != 0; }

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

/// Writes the wide tree, but for the bounds.
class Writer {
 public:
  Writer(const BinaryTree& tree, const Collapse& collapse, BvhLeaf leaf)
      : tree_(tree), collapse_(collapse), leaf_(leaf) {}

  Bvh write() {
    result_.nodes.push_back(unused_node());
    fill(0, 0);
    return std::move(result_);
  }

 private:
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

  /// Fills wide node `at` from binary node `root`, then its children.
  void fill(int root, std::size_t at) {
    const Collapse::Children children = collapse_.children(root);
    std::array<std::uint32_t, kBvhWidth> wide{};
    for (int i = 0; i < children.count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const BinaryNode& n = tree_.nodes[static_cast<std::size_t>(children.node[slot])];
      if (n.is_leaf()) {
        result_.nodes[at].child[slot] = make_leaf(n);
        continue;
      }
      wide[slot] = static_cast<std::uint32_t>(result_.nodes.size());
      result_.nodes[at].child[slot] = wide[slot];
      result_.nodes.push_back(unused_node());
    }
    for (int i = 0; i < children.count; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if (wide[slot] > 0) fill(children.node[slot], wide[slot]);
    }
  }

  const BinaryTree& tree_;
  const Collapse& collapse_;
  BvhLeaf leaf_;
  Bvh result_;
};

/// Bounds of a child over the shutter: they move from `start` to `end`.
void put_moving_box(BvhNode& node, BvhMotion& motion, std::size_t slot, const BvhBox& start,
                    const BvhBox& end) {
  for (int a = 0; a < 3; ++a) {
    // lo + time * (end - start), evaluated in float: one ulp of the larger end covers the rounding.
    const float slack = 4e-7F * std::max(std::max(std::fabs(start.lo[a]), std::fabs(start.hi[a])),
                                         std::max(std::fabs(end.lo[a]), std::fabs(end.hi[a])));
    node.lo[a][slot] = start.lo[a] - slack;
    node.hi[a][slot] = start.hi[a] + slack;
    motion.lo[a][slot] = end.lo[a] - start.lo[a];
    motion.hi[a][slot] = end.hi[a] - start.hi[a];
  }
}

/// What contains the boxes of a leaf.
BvhBox leaf_box(const Bvh& bvh, std::uint32_t child, std::span<const BvhBox> boxes, BvhLeaf leaf) {
  const std::size_t width = leaf == BvhLeaf::Blocks ? kBvhWidth : 1;
  BvhBox box = kNowhere;
  const std::size_t first = leaf_first(child) * width, end = first + leaf_count(child) * width;
  for (std::size_t i = first; i < end && bvh.items[i] != Bvh::kPadding; ++i)
    grow(box, boxes[bvh.items[i]]);
  return box;
}

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
    empty.nodes.push_back(unused_node());
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
  Bvh bvh = Writer(tree, Collapse(tree, leaf), leaf).write();
  refit_bvh(bvh, boxes, boxes_end, leaf);
  return bvh;
}

Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf) {
  Team alone(1);
  return build_bvh(boxes, boxes_end, leaf, alone);
}

void refit_bvh(Bvh& bvh, std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end,
               BvhLeaf leaf) {
  const bool moving = !boxes_end.empty();
  bvh.motion.resize(moving ? bvh.nodes.size() : 0);
  std::vector<BvhBox> start(bvh.nodes.size(), kNowhere), end(bvh.motion.size(), kNowhere);
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    BvhNode& node = bvh.nodes[i];
    for (std::size_t slot = 0; slot < kBvhWidth && is_used(node, slot); ++slot) {
      const std::uint32_t child = node.child[slot];
      const BvhBox box = is_leaf(child) ? leaf_box(bvh, child, boxes, leaf) : start[child];
      grow(start[i], box);
      if (moving) {
        const BvhBox after = is_leaf(child) ? leaf_box(bvh, child, boxes_end, leaf) : end[child];
        grow(end[i], after);
        put_moving_box(node, bvh.motion[i], slot, box, after);
        continue;
      }
      for (int a = 0; a < 3; ++a) {
        node.lo[a][slot] = box.lo[a];
        node.hi[a][slot] = box.hi[a];
      }
    }
  }
}

float expected_cost(const Bvh& bvh, BvhLeaf leaf) {
  BvhBox root = kNowhere;
  double cost = 0;
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
    const BvhNode& node = bvh.nodes[i];
    for (std::size_t slot = 0; slot < kBvhWidth && is_used(node, slot); ++slot) {
      BvhBox box{};
      for (int a = 0; a < 3; ++a) {
        const float lo = bvh.motion.empty() ? 0 : bvh.motion[i].lo[a][slot];
        const float hi = bvh.motion.empty() ? 0 : bvh.motion[i].hi[a][slot];
        box.lo[a] = node.lo[a][slot] + std::min(lo, 0.F);
        box.hi[a] = node.hi[a][slot] + std::max(hi, 0.F);
      }
      if (i == 0) grow(root, box);
      const std::uint32_t child = node.child[slot];
      const double area = half_area(box);
      cost += area * (is_leaf(child) ? double{leaf_cost(leaf, leaf_count(child))} : 1);
    }
  }
  const double of_root = half_area(root);
  return of_root > 0 ? static_cast<float>(1 + cost / of_root) : 0;
}

}  // namespace lightbench
