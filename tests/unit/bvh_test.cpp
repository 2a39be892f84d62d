// The tree as a value: what build_bvh() promises, for any boxes.

#include "core/accel/bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "core/parallel.h"

namespace lightbench {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

std::vector<BvhBox> random_boxes(std::size_t count, unsigned seed, float spread = 10,
                                 float size = 1) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> place(-spread, spread), extent(0, size);
  std::vector<BvhBox> boxes(count);
  for (BvhBox& b : boxes) {
    for (int k = 0; k < 3; ++k) {
      b.lo[k] = place(engine);
      b.hi[k] = b.lo[k] + extent(engine);
    }
  }
  return boxes;
}

/// Walks the tree and checks it: every item once, every box within its parent's slot (at both ends
/// and in the middle of the shutter), unused slots unreachable.
class Walk {
 public:
  Walk(const Bvh& bvh, const std::vector<BvhBox>& start, const std::vector<BvhBox>& end,
       BvhLeaf leaf)
      : bvh_(bvh), start_(start), end_(end), leaf_(leaf), seen_(start.size()) {}

  void run() {
    ASSERT_FALSE(bvh_.nodes.empty());
    ASSERT_EQ(bvh_.motion.size(), end_.empty() ? 0U : bvh_.nodes.size());
    visit(0, {{-kInf, -kInf, -kInf}, {kInf, kInf, kInf}}, 0.F, 1);
    for (const int n : seen_) EXPECT_EQ(n, 1) << "items must lie in one leaf each";
    for (const float time : {0.5F, 1.F}) {
      if (!end_.empty()) visit(0, {{-kInf, -kInf, -kInf}, {kInf, kInf, kInf}}, time, 1);
    }
    EXPECT_LE(deepest_, 70) << "deeper than the tracer's stack allows";
  }

 private:
  [[nodiscard]] BvhBox slot_box(std::uint32_t node, int k, float time) const {
    BvhBox b{};
    for (int a = 0; a < 3; ++a) {
      b.lo[a] = bvh_.nodes[node].lo[a][k];
      b.hi[a] = bvh_.nodes[node].hi[a][k];
      if (bvh_.motion.empty()) continue;
      b.lo[a] = std::fma(bvh_.motion[node].lo[a][k], time, b.lo[a]);
      b.hi[a] = std::fma(bvh_.motion[node].hi[a][k], time, b.hi[a]);
    }
    return b;
  }

  [[nodiscard]] BvhBox item_box(std::uint32_t i, float time) const {
    if (end_.empty()) return start_[i];
    BvhBox b{};
    for (int a = 0; a < 3; ++a) {
      b.lo[a] =
          static_cast<float>((1 - double{time}) * start_[i].lo[a] + double{time} * end_[i].lo[a]);
      b.hi[a] =
          static_cast<float>((1 - double{time}) * start_[i].hi[a] + double{time} * end_[i].hi[a]);
    }
    return b;
  }

  static bool contains(const BvhBox& outer, const BvhBox& inner) {
    for (int a = 0; a < 3; ++a) {
      // Children of a moving node carry a slack of their own.
      const float slack = 1e-5F * (1 + std::abs(outer.lo[a]) + std::abs(outer.hi[a]));
      const float room = std::isfinite(slack) ? slack : 0;
      if (inner.lo[a] < outer.lo[a] - room || inner.hi[a] > outer.hi[a] + room) return false;
    }
    return true;
  }

  static bool contains_exactly(const BvhBox& outer, const BvhBox& inner) {
    for (int a = 0; a < 3; ++a) {
      if (inner.lo[a] < outer.lo[a] || inner.hi[a] > outer.hi[a]) return false;
    }
    return true;
  }

  void visit(std::uint32_t node, const BvhBox& bounds, float time, int depth) {
    deepest_ = std::max(deepest_, depth);
    ASSERT_LT(node, bvh_.nodes.size());
    for (int k = 0; k < kBvhWidth; ++k) {
      const BvhBox box = slot_box(node, k, 0);
      if (box.lo[0] > box.hi[0]) {
        EXPECT_EQ(box.lo[0], kInf) << "an unused slot must be out of every ray's reach";
        continue;
      }
      const BvhBox now = slot_box(node, k, time);
      EXPECT_TRUE(contains(bounds, now)) << "a child sticks out of its parent";
      const std::uint32_t child = bvh_.nodes[node].child[k];
      if (is_leaf(child)) {
        check_leaf(child, now, time);
      } else {
        EXPECT_GT(child, node) << "children come after their parents";
        visit(child, now, time, depth + 1);
      }
    }
  }

  void check_leaf(std::uint32_t child, const BvhBox& box, float time) {
    const std::uint32_t width = leaf_ == BvhLeaf::Blocks ? kBvhWidth : 1;
    const std::uint32_t first = leaf_first(child) * width, count = leaf_count(child) * width;
    ASSERT_GE(leaf_count(child), 1U);
    ASSERT_LE(first + count, bvh_.items.size());
    for (std::uint32_t i = first; i < first + count; ++i) {
      const std::uint32_t item = bvh_.items[i];
      if (item == Bvh::kPadding) {
        EXPECT_EQ(leaf_, BvhLeaf::Blocks);
        continue;
      }
      ASSERT_LT(item, start_.size());
      if (time == 0) ++seen_[item];
      EXPECT_TRUE(contains_exactly(box, item_box(item, time)))
          << "an item sticks out of its leaf at time " << time;
    }
  }

  const Bvh& bvh_;
  const std::vector<BvhBox>& start_;
  const std::vector<BvhBox>& end_;
  BvhLeaf leaf_;
  std::vector<int> seen_;
  int deepest_ = 0;
};

void check(const std::vector<BvhBox>& start, const std::vector<BvhBox>& end, const char* what) {
  for (const BvhLeaf leaf : {BvhLeaf::Items, BvhLeaf::Blocks}) {
    SCOPED_TRACE(std::string(what) + (leaf == BvhLeaf::Items ? ", items" : ", blocks"));
    const Bvh bvh = build_bvh(start, end, leaf);
    Walk(bvh, start, end, leaf).run();
  }
}

TEST(Bvh, HoldsEveryItemOnceWithinItsBoxes) {
  for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 8U, 9U, 17U, 64U, 100U, 1000U, 5000U}) {
    check(random_boxes(n, static_cast<unsigned>(n)), {}, std::to_string(n).c_str());
  }
}

TEST(Bvh, HoldsMovingItemsAtAllTimes) {
  for (const std::size_t n : {1U, 7U, 200U, 2000U}) {
    check(random_boxes(n, 1), random_boxes(n, 2), std::to_string(n).c_str());
  }
}

TEST(Bvh, TakesDegenerateInput) {
  const Bvh none = build_bvh({}, {}, BvhLeaf::Items);
  ASSERT_EQ(none.nodes.size(), 1U);
  for (int k = 0; k < kBvhWidth; ++k) EXPECT_GT(none.nodes[0].lo[0][k], none.nodes[0].hi[0][k]);
  EXPECT_TRUE(none.items.empty());

  const BvhBox unit{{0, 0, 0}, {1, 1, 1}}, point{{2, 2, 2}, {2, 2, 2}};
  check(std::vector<BvhBox>(1000, unit), {}, "identical boxes");
  check(std::vector<BvhBox>(1000, point), {}, "identical points");
  check(random_boxes(300, 3, 1e18F, 1e17F), {}, "huge");
  check(random_boxes(300, 4, 1e-18F, 1e-19F), {}, "tiny");
  // Centres at 1, 1/2, 1/4, ...: every split leaves all but a few on one side.
  std::vector<BvhBox> geometric;
  for (int i = 0; i < 400; ++i) {
    const auto x = static_cast<float>(std::ldexp(1.0, -(i % 120)));
    geometric.push_back({{x, 0, 0}, {x, 1e-30F, 1e-30F}});
  }
  check(geometric, {}, "geometric");
  std::vector<BvhBox> flat = random_boxes(200, 5);
  for (BvhBox& b : flat) b.lo[1] = b.hi[1] = 0;
  check(flat, {}, "flat");
}

TEST(Bvh, IsTheSameEveryTime) {
  const auto boxes = random_boxes(700, 8);
  const Bvh a = build_bvh(boxes, {}, BvhLeaf::Items), b = build_bvh(boxes, {}, BvhLeaf::Items);
  EXPECT_EQ(a.items, b.items);
  EXPECT_EQ(a.nodes.size(), b.nodes.size());
}

bool same_tree(const Bvh& a, const Bvh& b) {
  return a.items == b.items && a.nodes.size() == b.nodes.size() &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0 &&
         a.motion.size() == b.motion.size();
}

TEST(Bvh, IsTheSameForAnyNumberOfThreads) {
  auto boxes = random_boxes(60000, 10, 10, 0.1F);
  for (std::size_t i = 0; i < 30000; ++i) boxes[i] = boxes[i % 7];  // ties: order must decide
  const auto end = random_boxes(60000, 11, 10, 0.1F);
  for (const BvhLeaf leaf : {BvhLeaf::Items, BvhLeaf::Blocks}) {
    const Bvh alone = build_bvh(boxes, {}, leaf), moving = build_bvh(boxes, end, leaf);
    Walk(alone, boxes, {}, leaf).run();
    for (const unsigned threads : {2U, 3U, 16U, 0U}) {
      Team team(threads);
      EXPECT_TRUE(same_tree(alone, build_bvh(boxes, {}, leaf, team))) << threads;
      EXPECT_TRUE(same_tree(moving, build_bvh(boxes, end, leaf, team))) << threads;
    }
  }
}

TEST(Bvh, FillsNodesAndBlocks) {
  const auto boxes = random_boxes(20000, 12, 10, 0.1F);
  const Bvh bvh = build_bvh(boxes, {}, BvhLeaf::Blocks);
  const auto nodes = static_cast<double>(bvh.nodes.size());
  const auto blocks = static_cast<double>(bvh.items.size()) / kBvhWidth;
  // Opening the largest child first leaves 3.9 children to a node.
  EXPECT_GT((nodes - 1 + blocks) / nodes, 5);
  EXPECT_GT(static_cast<double>(boxes.size()) / static_cast<double>(bvh.items.size()), 0.8);
}

TEST(Bvh, IsFittedToBoxesThatMove) {
  for (const BvhLeaf leaf : {BvhLeaf::Items, BvhLeaf::Blocks}) {
    for (const std::size_t n : {1U, 9U, 3000U}) {
      SCOPED_TRACE(n);
      const auto before = random_boxes(n, 20), after = random_boxes(n, 21, 30, 2);
      const auto later = random_boxes(n, 22);
      const Bvh built = build_bvh(before, {}, leaf);
      Bvh bvh = built;
      refit_bvh(bvh, after, {}, leaf);
      Walk(bvh, after, {}, leaf).run();
      refit_bvh(bvh, after, later, leaf);  // sets out to move within the shutter
      Walk(bvh, after, later, leaf).run();
      refit_bvh(bvh, before, {}, leaf);
      EXPECT_TRUE(same_tree(bvh, built));
    }
  }
}

TEST(Bvh, CostsWhatTheSurfaceAreaHeuristicSays) {
  // Eight cubes in a row, 1 apart: one node.
  std::vector<BvhBox> boxes;
  for (int i = 0; i < 8; ++i) {
    const auto x = static_cast<float>(2 * i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  const Bvh bvh = build_bvh(boxes, {}, BvhLeaf::Items);
  ASSERT_EQ(bvh.nodes.size(), 1U);
  // The root, and each item by the share of the whole box's surface (1 x 1 x 15: 31) that its own
  // has (3); both in halves. A test costs 1.25 nodes.
  EXPECT_FLOAT_EQ(expected_cost(bvh, BvhLeaf::Items), 1 + 1.25F * 8 * 3.F / 31);
}

TEST(Bvh, CostsMoreTheFartherItsBoxesMoved) {
  const auto boxes = random_boxes(3000, 23, 10, 0.2F);
  Bvh bvh = build_bvh(boxes, {}, BvhLeaf::Items);
  const float built = expected_cost(bvh, BvhLeaf::Items);
  float last = built;
  const auto towards = random_boxes(3000, 24, 10, 0.2F);
  for (const float share : {0.01F, 0.1F, 1.F}) {
    auto moved = boxes;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const float d = share * (towards[i].lo[k] - boxes[i].lo[k]);
        moved[i].lo[k] += d;
        moved[i].hi[k] += d;
      }
    }
    refit_bvh(bvh, moved, {}, BvhLeaf::Items);
    EXPECT_GT(expected_cost(bvh, BvhLeaf::Items), last) << share;
    last = expected_cost(bvh, BvhLeaf::Items);
  }
  EXPECT_GT(last, 3 * built);
}

TEST(Bvh, RoundsBoxesOutward) {
  std::mt19937_64 engine(9);
  std::uniform_real_distribution<double> x(-1e6, 1e6);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(engine() % 60) - 40);
    const double lo[3] = {x(engine) * scale, 0.1, 1.0}, hi[3] = {lo[0] + 0.1 * scale, 0.3, 1.0};
    const BvhBox b = outward_box(lo, hi);
    for (int k = 0; k < 3; ++k) {
      ASSERT_LE(static_cast<double>(b.lo[k]), lo[k]);
      ASSERT_GE(static_cast<double>(b.hi[k]), hi[k]);
      // By one step of float at most.
      ASSERT_GE(static_cast<double>(std::nextafter(b.lo[k], kInf)), lo[k]);
      ASSERT_LE(static_cast<double>(std::nextafter(b.hi[k], -kInf)), hi[k]);
    }
  }
}

}  // namespace
}  // namespace lightbench
