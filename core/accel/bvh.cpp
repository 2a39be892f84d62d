#include "core/accel/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace lightbench {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kBins = 16;
constexpr int kMaxSahDepth = 48;  // below it halves, so that the tracer's stack is never exceeded

BvhBox empty_box() { return {{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}}; }

void grow(BvhBox& a, const BvhBox& b) {
  for (int k = 0; k < 3; ++k) {
    a.lo[k] = std::min(a.lo[k], b.lo[k]);
    a.hi[k] = std::max(a.hi[k], b.hi[k]);
  }
}

float half_area(const BvhBox& b) {
  const float x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1], z = b.hi[2] - b.lo[2];
  return x < 0 ? 0 : x * y + y * z + z * x;
}

struct BinaryNode {
  BvhBox start, end, whole;
  int left = -1, right = -1;
  std::uint32_t first = 0, count = 0;
};

class Builder {
 public:
  Builder(std::span<const BvhBox> start, std::span<const BvhBox> end, BvhLeaf leaf)
      : start_(start), end_(end), leaf_(leaf), order_(start.size()), centers_(start.size()) {
    for (std::uint32_t i = 0; i < order_.size(); ++i) {
      order_[i] = i;
      const BvhBox b = whole(i);
      for (std::size_t k = 0; k < 3; ++k) centers_[i][k] = 0.5F * (b.lo[k] + b.hi[k]);
    }
    binary_.reserve(2 * order_.size() + 1);
  }

  Bvh build() {
    if (order_.empty()) {
      result_.nodes.push_back(empty_node());
      if (!end_.empty()) result_.motion.push_back({});
      return std::move(result_);
    }
    const int root = split(0, static_cast<std::uint32_t>(order_.size()), 0);
    result_.nodes.push_back(empty_node());
    if (!end_.empty()) result_.motion.push_back({});
    collapse(root, 0);
    return std::move(result_);
  }

 private:
  static BvhNode empty_node() {
    BvhNode node{};
    for (int a = 0; a < 3; ++a) {
      std::fill(std::begin(node.lo[a]), std::end(node.lo[a]), kInf);
      std::fill(std::begin(node.hi[a]), std::end(node.hi[a]), -kInf);
    }
    return node;
  }

  [[nodiscard]] BvhBox whole(std::uint32_t i) const {
    BvhBox b = start_[i];
    if (!end_.empty()) grow(b, end_[i]);
    return b;
  }

  /// Tests that a leaf of n items costs, against 1 for a node.
  [[nodiscard]] float leaf_cost(std::uint32_t n) const {
    const std::uint32_t blocks = (n + kBvhWidth - 1) / kBvhWidth;
    return static_cast<float>(leaf_ == BvhLeaf::Blocks ? blocks : n);
  }

  int split(std::uint32_t first, std::uint32_t count, int depth) {
    BinaryNode node;
    node.start = node.end = node.whole = empty_box();
    BvhBox centers = empty_box();
    for (std::uint32_t i = first; i < first + count; ++i) {
      const std::uint32_t item = order_[i];
      grow(node.start, start_[item]);
      if (!end_.empty()) grow(node.end, end_[item]);
      grow(node.whole, whole(item));
      for (std::size_t k = 0; k < 3; ++k) {
        centers.lo[k] = std::min(centers.lo[k], centers_[item][k]);
        centers.hi[k] = std::max(centers.hi[k], centers_[item][k]);
      }
    }
    node.first = first;
    node.count = count;
    const auto at = static_cast<int>(binary_.size());
    binary_.push_back(node);
    const std::uint32_t largest_leaf = leaf_ == BvhLeaf::Blocks ? kBvhWidth : 4;
    if (count == 1 || (leaf_ == BvhLeaf::Blocks && count <= kBvhWidth)) return at;
    std::uint32_t middle = first;
    const float best_cost =
        depth < kMaxSahDepth ? partition(first, count, centers, node.whole, middle) : kInf;
    if (count <= largest_leaf && !(best_cost < leaf_cost(count))) return at;
    if (middle == first || middle == first + count) {
      // All centres coincide, or the tree is too deep: halve along the widest axis.
      int axis = 0;
      for (int k = 1; k < 3; ++k) {
        if (centers.hi[k] - centers.lo[k] > centers.hi[axis] - centers.lo[axis]) axis = k;
      }
      middle = first + count / 2;
      std::nth_element(order_.begin() + first, order_.begin() + middle,
                       order_.begin() + first + count, [&](std::uint32_t a, std::uint32_t b) {
                         return centers_[a][static_cast<std::size_t>(axis)] <
                                centers_[b][static_cast<std::size_t>(axis)];
                       });
    }
    const int left = split(first, middle - first, depth + 1);
    const int right = split(middle, first + count - middle, depth + 1);
    binary_[static_cast<std::size_t>(at)].left = left;
    binary_[static_cast<std::size_t>(at)].right = right;
    return at;
  }

  /// Best binned split: reorders the range, sets `middle`, returns the expected cost.
  float partition(std::uint32_t first, std::uint32_t count, const BvhBox& centers,
                  const BvhBox& whole_box, std::uint32_t& middle) {
    struct Bin {
      BvhBox box = empty_box();
      std::uint32_t count = 0;
    };
    float best = kInf;
    std::size_t best_axis = 0;
    int best_bin = -1;
    const auto bin_of = [&](std::uint32_t item, std::size_t axis, float scale) {
      const float x = (centers_[item][axis] - centers.lo[axis]) * scale;
      return std::min(static_cast<int>(x), kBins - 1);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float extent = centers.hi[axis] - centers.lo[axis];
      if (!(extent > 0)) continue;
      const float scale = static_cast<float>(kBins) / extent;
      if (!std::isfinite(scale)) continue;
      std::array<Bin, kBins> bins;
      for (std::uint32_t i = first; i < first + count; ++i) {
        Bin& bin = bins[static_cast<std::size_t>(bin_of(order_[i], axis, scale))];
        grow(bin.box, whole(order_[i]));
        ++bin.count;
      }
      std::array<float, kBins> right_cost{};
      BvhBox box = empty_box();
      std::uint32_t n = 0;
      for (std::size_t b = kBins - 1; b > 0; --b) {
        grow(box, bins[b].box);
        n += bins[b].count;
        right_cost[b] = half_area(box) * leaf_cost(n);
      }
      box = empty_box();
      n = 0;
      for (std::size_t b = 0; b + 1 < kBins; ++b) {
        grow(box, bins[b].box);
        n += bins[b].count;
        if (n == 0 || n == count) continue;
        const float cost = half_area(box) * leaf_cost(n) + right_cost[b + 1];
        if (cost < best) {
          best = cost;
          best_axis = axis;
          best_bin = static_cast<int>(b);
        }
      }
    }
    if (best_bin < 0) return kInf;
    const float scale = static_cast<float>(kBins) / (centers.hi[best_axis] - centers.lo[best_axis]);
    const auto cut = std::partition(
        order_.begin() + first, order_.begin() + first + count,
        [&](std::uint32_t item) { return bin_of(item, best_axis, scale) <= best_bin; });
    middle = static_cast<std::uint32_t>(cut - order_.begin());
    const float area = half_area(whole_box);
    return area > 0 ? 1 + best / area : kInf;
  }

  [[nodiscard]] const BinaryNode& node(int i) const { return binary_[static_cast<std::size_t>(i)]; }

  std::uint32_t make_leaf(const BinaryNode& n) {
    std::uint32_t first = 0, count = n.count;
    if (leaf_ == BvhLeaf::Blocks) {
      first = static_cast<std::uint32_t>(result_.items.size() / kBvhWidth);
      count = 1;
    } else {
      first = static_cast<std::uint32_t>(result_.items.size());
    }
    if (first >= (1U << 24)) {
      throw Error(
          ErrorKind::Scene,
          "scene: too many primitives for one acceleration structure (limit 16.7 million leaves)");
    }
    for (std::uint32_t i = 0; i < n.count; ++i) result_.items.push_back(order_[n.first + i]);
    if (leaf_ == BvhLeaf::Blocks) {
      while (result_.items.size() % kBvhWidth != 0) result_.items.push_back(Bvh::kPadding);
    }
    return BvhNode::kLeaf | count << 24 | first;
  }

  /// Fills wide node `at` from binary node `root`.
  void collapse(int root, std::size_t at) {
    std::array<int, kBvhWidth> children{};
    int used = 1;
    children[0] = root;
    while (used < kBvhWidth) {
      int widest = -1;
      float area = -1;
      for (int i = 0; i < used; ++i) {
        const BinaryNode& n = node(children[static_cast<std::size_t>(i)]);
        if (n.left >= 0 && half_area(n.whole) > area) {
          area = half_area(n.whole);
          widest = i;
        }
      }
      if (widest < 0) break;
      const BinaryNode& n = node(children[static_cast<std::size_t>(widest)]);
      children[static_cast<std::size_t>(widest)] = n.left;
      children[static_cast<std::size_t>(used++)] = n.right;
    }
    std::array<int, kBvhWidth> wide{};
    for (int i = 0; i < used; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const BinaryNode n = node(children[slot]);
      BvhNode& target = result_.nodes[at];
      for (int a = 0; a < 3; ++a) {
        target.lo[a][slot] = n.start.lo[a];
        target.hi[a][slot] = n.start.hi[a];
        if (end_.empty()) continue;
        // lo + time * (end - start), evaluated in float: one ulp of the larger end covers the
        // rounding.
        const float slack =
            4e-7F * std::max(std::max(std::fabs(n.start.lo[a]), std::fabs(n.start.hi[a])),
                             std::max(std::fabs(n.end.lo[a]), std::fabs(n.end.hi[a])));
        target.lo[a][slot] -= slack;
        target.hi[a][slot] += slack;
        result_.motion[at].lo[a][slot] = n.end.lo[a] - n.start.lo[a];
        result_.motion[at].hi[a][slot] = n.end.hi[a] - n.start.hi[a];
      }
      if (n.left < 0) {
        target.child[slot] = make_leaf(n);
      } else {
        wide[slot] = static_cast<int>(result_.nodes.size());
        target.child[slot] = static_cast<std::uint32_t>(result_.nodes.size());
        result_.nodes.push_back(empty_node());
        if (!end_.empty()) result_.motion.push_back({});
      }
    }
    for (int i = 0; i < used; ++i) {
      const auto slot = static_cast<std::size_t>(i);
      if (wide[slot] > 0) collapse(children[slot], static_cast<std::size_t>(wide[slot]));
    }
  }

  std::span<const BvhBox> start_, end_;
  BvhLeaf leaf_;
  std::vector<std::uint32_t> order_;
  std::vector<std::array<float, 3>> centers_;
  std::vector<BinaryNode> binary_;
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

Bvh build_bvh(std::span<const BvhBox> boxes, std::span<const BvhBox> boxes_end, BvhLeaf leaf) {
  return Builder(boxes, boxes_end, leaf).build();
}

}  // namespace lightbench
