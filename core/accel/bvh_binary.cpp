#include "core/accel/bvh_binary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "core/parallel.h"

namespace lightbench {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kBins = 16;
constexpr int kMaxSahDepth = 48;  // below it halves, so that the tracer's stack is never exceeded
/// Boxes that one thread takes at a time; ranges up to this long are one thread's alone.
constexpr std::uint32_t kRun = 16384;

// x, y, z and a number that does not matter.
typedef float Four __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));

Four min(Four a, Four b) { return a < b ? a : b; }
Four max(Four a, Four b) { return a > b ? a : b; }

/// A box in vectors; not initialised.
struct Box {
  Four lo, hi;
  void grow(const Box& b) {
    lo = min(lo, b.lo);
    hi = max(hi, b.hi);
  }
  void grow(Four p) {
    lo = min(lo, p);
    hi = max(hi, p);
  }
  [[nodiscard]] Four twice_center() const { return lo + hi; }
};

constexpr Box kEmpty{Four{kInf, kInf, kInf, kInf}, Four{-kInf, -kInf, -kInf, -kInf}};

Box to_box(const BvhBox& b) {
  return {Four{b.lo[0], b.lo[1], b.lo[2], 0}, Four{b.hi[0], b.hi[1], b.hi[2], 0}};
}
BvhBox to_bvh_box(const Box& b) {
  return {{b.lo[0], b.lo[1], b.lo[2]}, {b.hi[0], b.hi[1], b.hi[2]}};
}

/// Which bin a centre falls into along each axis. An axis along which the centres do not differ, or
/// by less than can be divided by, has scale 0: all are in its first bin.
struct Binning {
  Four base, scale;
  explicit Binning(const Box& centers) : base(centers.lo), scale{} {
    for (int k = 0; k < 3; ++k) {
      const float s = static_cast<float>(kBins) / (centers.hi[k] - centers.lo[k]);
      scale[k] = centers.hi[k] > centers.lo[k] && std::isfinite(s) ? s : 0;
    }
  }
  [[nodiscard]] FourInts of(const Box& b) const {
    const Four last = Four{} + static_cast<float>(kBins - 1);
    return __builtin_convertvector(min((b.twice_center() - base) * scale, last), FourInts);
  }
};

struct Bins {
  std::array<std::array<Box, kBins>, 3> box;
  std::array<std::array<std::uint32_t, kBins>, 3> count{};
  Bins() {
    for (auto& axis : box) axis.fill(kEmpty);
  }
};

void add(const Bins& from, Bins& into) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < kBins; ++b) {
      into.box[a][b].grow(from.box[a][b]);
      into.count[a][b] += from.count[a][b];
    }
  }
}

struct Split {
  int axis = 0, bin = -1;  ///< the left part's last bin; negative: no split
  float cost = kInf;       ///< expected cost of both parts times the area of their parent
  std::uint32_t left_count = 0;
  Box left = kEmpty, right = kEmpty;
};

Split best_split(const Bins& bins, std::uint32_t count, BvhLeaf leaf) {
  Split best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& box = bins.box[axis];
    std::array<float, kBins> right_cost{};
    Box right = kEmpty;
    std::uint32_t n = 0;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      right.grow(box[b]);
      n += bins.count[axis][b];
      right_cost[b] = half_area(to_bvh_box(right)) * leaf_cost(leaf, n);
    }
    Box left = kEmpty;
    n = 0;
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
      left.grow(box[b]);
      n += bins.count[axis][b];
      if (n == 0 || n == count) continue;
      const float cost = half_area(to_bvh_box(left)) * leaf_cost(leaf, n) + right_cost[b + 1];
      if (cost < best.cost) {
        best.axis = static_cast<int>(axis);
        best.bin = static_cast<int>(b);
        best.cost = cost;
        best.left_count = n;
        best.left = left;
      }
    }
  }
  if (best.bin < 0) return best;
  const auto axis = static_cast<std::size_t>(best.axis);
  for (auto b = static_cast<std::size_t>(best.bin) + 1; b < kBins; ++b) {
    best.right.grow(bins.box[axis][b]);
  }
  return best;
}

class Builder {
 public:
  Builder(std::span<const BvhBox> boxes, BvhLeaf leaf, Team& team) : leaf_(leaf), team_(team) {
    // Their memory is first touched by the threads that fill it.
    for (Buffer& b : buffers_) {
      b.box = std::make_unique_for_overwrite<Box[]>(boxes.size());
      b.item = std::make_unique_for_overwrite<std::uint32_t[]>(boxes.size());
    }
    std::vector<Box> parts((boxes.size() + kRun - 1) / kRun);
    team_.runs(boxes.size(), kRun, [&](std::size_t begin, std::size_t end) {
      Box part = kEmpty;
      for (std::size_t i = begin; i < end; ++i) {
        buffers_[0].box[i] = to_box(boxes[i]);
        buffers_[0].item[i] = static_cast<std::uint32_t>(i);
        part.grow(buffers_[0].box[i]);
      }
      parts[begin / kRun] = part;
    });
    for (const Box& part : parts) whole_.grow(part);
    tree_.items.resize(boxes.size());
  }

  BinaryTree build() {
    // Long ranges are split by all threads together, what is left by one thread each.
    std::vector<Range> open{{0, static_cast<std::uint32_t>(tree_.items.size()), 0, 0, whole_}};
    std::vector<Range> short_ranges;
    std::vector<std::size_t> node_of_short;
    std::vector<std::size_t> node_of_open{0};
    tree_.nodes.push_back(new_node(open[0]));
    while (!open.empty()) {
      const Range range = open.back();
      const std::size_t at = node_of_open.back();
      open.pop_back();
      node_of_open.pop_back();
      if (range.count <= kRun) {
        short_ranges.push_back(range);
        node_of_short.push_back(at);
        continue;
      }
      Range left, right;
      if (!split(range, left, right)) {
        finish_leaf(range);
        continue;
      }
      tree_.nodes[at].left = static_cast<int>(tree_.nodes.size());
      tree_.nodes.push_back(new_node(left));
      tree_.nodes[at].right = static_cast<int>(tree_.nodes.size());
      tree_.nodes.push_back(new_node(right));
      open.push_back(left);
      node_of_open.push_back(tree_.nodes.size() - 2);
      open.push_back(right);
      node_of_open.push_back(tree_.nodes.size() - 1);
    }
    std::vector<std::vector<BinaryNode>> subtrees(short_ranges.size());
    team_.each(short_ranges.size(), [&](std::size_t i) {
      subtrees[i].reserve(short_ranges[i].count / 2);
      build_alone(short_ranges[i], subtrees[i]);
    });
    for (std::size_t i = 0; i < subtrees.size(); ++i) graft(subtrees[i], node_of_short[i]);
    return std::move(tree_);
  }

 private:
  /// Boxes and their numbers; a range lies in one of two, and its parts in the other.
  struct Buffer {
    std::unique_ptr<Box[]> box;
    std::unique_ptr<std::uint32_t[]> item;
  };
  struct Range {
    std::uint32_t first, count;
    int depth;
    unsigned buffer;
    Box box;
  };

  static BinaryNode new_node(const Range& r) {
    return {to_bvh_box(r.box), r.first, r.count, -1, -1};
  }

  void finish_leaf(const Range& r) {
    const std::uint32_t* from = buffers_[r.buffer].item.get() + r.first;
    std::copy(from, from + r.count, tree_.items.begin() + r.first);
  }

  int build_alone(const Range& range, std::vector<BinaryNode>& nodes) {
    const auto at = static_cast<std::size_t>(nodes.size());
    nodes.push_back(new_node(range));
    Range left, right;
    if (!split(range, left, right)) {
      finish_leaf(range);
      return static_cast<int>(at);
    }
    const int left_child = build_alone(left, nodes);
    const int right_child = build_alone(right, nodes);
    nodes[at].left = left_child;
    nodes[at].right = right_child;
    return static_cast<int>(at);
  }

  /// Puts a subtree in the place of node `at`.
  void graft(const std::vector<BinaryNode>& subtree, std::size_t at) {
    const int offset = static_cast<int>(tree_.nodes.size()) - 1;  // the root goes elsewhere
    const auto moved = [offset](BinaryNode n) {
      if (!n.is_leaf()) {
        n.left += offset;
        n.right += offset;
      }
      return n;
    };
    tree_.nodes[at] = moved(subtree[0]);
    for (std::size_t i = 1; i < subtree.size(); ++i) tree_.nodes.push_back(moved(subtree[i]));
  }

  /// Splits a range in two, or returns false where it is to be a leaf.
  bool split(const Range& range, Range& left, Range& right) {
    const std::uint32_t largest_leaf = leaf_ == BvhLeaf::Blocks ? kBvhWidth : 4;
    if (range.count == 1 || (leaf_ == BvhLeaf::Blocks && range.count <= kBvhWidth)) return false;
    const Box centers = center_box(range);
    Split best;
    if (range.depth < kMaxSahDepth) {
      const Binning binning(centers);
      best = best_split(fill_bins(range, binning), range.count, leaf_);
      const float area = half_area(to_bvh_box(range.box));
      const float cost = best.bin >= 0 && area > 0 ? 1 + best.cost / area : kInf;
      if (range.count <= largest_leaf && !(cost < leaf_cost(leaf_, range.count))) return false;
      if (best.bin >= 0) partition(range, binning, best);
    } else if (range.count <= largest_leaf) {
      return false;
    }
    if (best.bin < 0) best = halve(range, centers);
    left = {range.first, best.left_count, range.depth + 1, 1 - range.buffer, best.left};
    right = {range.first + best.left_count, range.count - best.left_count, range.depth + 1,
             1 - range.buffer, best.right};
    return true;
  }

  /// Twice the centres' bounds.
  Box center_box(const Range& r) {
    const Box* boxes = buffers_[r.buffer].box.get() + r.first;
    const auto measure = [&](std::size_t begin, std::size_t end) {
      Box b = kEmpty;
      for (std::size_t i = begin; i < end; ++i) b.grow(boxes[i].twice_center());
      return b;
    };
    if (r.count <= kRun) return measure(0, r.count);
    std::vector<Box> parts((r.count + kRun - 1) / kRun);
    team_.runs(r.count, kRun, [&](std::size_t begin, std::size_t end) {
      parts[begin / kRun] = measure(begin, end);
    });
    Box all = kEmpty;
    for (const Box& b : parts) all.grow(b);
    return all;
  }

  Bins fill_bins(const Range& r, const Binning& binning) {
    const Box* boxes = buffers_[r.buffer].box.get() + r.first;
    const auto fill = [&](std::size_t begin, std::size_t end, Bins& bins) {
      for (std::size_t i = begin; i < end; ++i) {
        const FourInts bin = binning.of(boxes[i]);
        for (std::size_t a = 0; a < 3; ++a) {
          const auto b = static_cast<std::size_t>(bin[a]);
          bins.box[a][b].grow(boxes[i]);
          ++bins.count[a][b];
        }
      }
    };
    Bins all;
    if (r.count <= kRun) {
      fill(0, r.count, all);
      return all;
    }
    std::vector<Bins> parts((r.count + kRun - 1) / kRun);
    team_.runs(r.count, kRun,
               [&](std::size_t begin, std::size_t end) { fill(begin, end, parts[begin / kRun]); });
    for (const Bins& b : parts) add(b, all);
    return all;
  }

  /// Moves the range to the other buffer, the left part first; each part keeps its order.
  void partition(const Range& r, const Binning& binning, const Split& s) {
    const Buffer& from = buffers_[r.buffer];
    Buffer& to = buffers_[1 - r.buffer];
    const auto is_left = [&](std::size_t i) {
      return binning.of(from.box[r.first + i])[s.axis] <= s.bin;
    };
    const auto move = [&](std::size_t begin, std::size_t end, std::size_t left, std::size_t right) {
      for (std::size_t i = begin; i < end; ++i) {
        const bool goes_left = is_left(i);
        const std::size_t at = r.first + (goes_left ? left : right);
        to.box[at] = from.box[r.first + i];
        to.item[at] = from.item[r.first + i];
        left += goes_left ? 1 : 0;
        right += goes_left ? 0 : 1;
      }
    };
    if (r.count <= kRun) {
      move(0, r.count, 0, s.left_count);
      return;
    }
    std::vector<std::size_t> left_before((r.count + kRun - 1) / kRun + 1);
    team_.runs(r.count, kRun, [&](std::size_t begin, std::size_t end) {
      std::size_t n = 0;
      for (std::size_t i = begin; i < end; ++i) n += is_left(i) ? 1 : 0;
      left_before[begin / kRun + 1] = n;
    });
    std::partial_sum(left_before.begin(), left_before.end(), left_before.begin());
    team_.runs(r.count, kRun, [&](std::size_t begin, std::size_t end) {
      const std::size_t left = left_before[begin / kRun];
      move(begin, end, left, s.left_count + (begin - left));
    });
  }

  /// All centres coincide, or the tree is too deep: halves along the widest axis.
  Split halve(const Range& r, const Box& centers) {
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
      if (centers.hi[k] - centers.lo[k] > centers.hi[axis] - centers.lo[axis]) axis = k;
    }
    const Buffer& from = buffers_[r.buffer];
    Buffer& to = buffers_[1 - r.buffer];
    std::vector<std::uint32_t> order(r.count);
    std::iota(order.begin(), order.end(), r.first);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return from.box[a].twice_center()[axis] < from.box[b].twice_center()[axis];
    });
    Split s;
    s.left_count = r.count / 2;
    for (std::uint32_t i = 0; i < r.count; ++i) {
      to.box[r.first + i] = from.box[order[i]];
      to.item[r.first + i] = from.item[order[i]];
      (i < s.left_count ? s.left : s.right).grow(from.box[order[i]]);
    }
    return s;
  }

  BvhLeaf leaf_;
  Team& team_;
  std::array<Buffer, 2> buffers_;
  Box whole_ = kEmpty;
  BinaryTree tree_;
};

}  // namespace

BinaryTree build_binary_tree(std::span<const BvhBox> boxes, BvhLeaf leaf, Team& team) {
  return Builder(boxes, leaf, team).build();
}

}  // namespace lightbench
