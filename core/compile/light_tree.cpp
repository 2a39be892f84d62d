#include "core/compile/light_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <span>

namespace lightbench {
namespace {

using glm::dot;
using glm::dvec3;
using glm::length;

/// What a node says of its lamps: a ball around them, and a cone around the normals of their
/// fronts.
struct Cluster {
  dvec3 center{0};
  double radius = 0, weight = 0;
  dvec3 axis{0, 0, 1};
  double cosine = -1;  ///< of the cone's half angle; -1: they shine all around
};

Cluster cluster_of(const std::vector<Lamp>& lamps, std::span<const std::uint32_t> members) {
  Cluster c;
  dvec3 low(std::numeric_limits<double>::infinity()), high(-low), normals(0);
  bool flat = true;
  for (const std::uint32_t i : members) {
    const Lamp& lamp = lamps[i];
    low = glm::min(low, lamp.place.center);
    high = glm::max(high, lamp.place.center);
    c.weight += lamp.weight;
    flat = flat && lamp.place.normal != dvec3(0) && !lamp.two_sided;
    normals += lamp.weight * lamp.place.normal;
  }
  c.center = 0.5 * (low + high);
  for (const std::uint32_t i : members) {
    const LightPlacement& place = lamps[i].place;
    c.radius = std::max(c.radius, length(place.center - c.center) + place.radius());
  }
  if (flat && length(normals) > 1e-6 * c.weight) {
    c.axis = glm::normalize(normals);
    c.cosine = 1;
    for (const std::uint32_t i : members) {
      c.cosine = std::min(c.cosine, dot(c.axis, lamps[i].place.normal));
    }
    // A cone of more than a half turn says too little for what it costs.
    if (c.cosine < 0) c.cosine = -1;
  }
  return c;
}

template <class T>
class Builder {
 public:
  Builder(const std::vector<Lamp>& lamps, LightPart<T>& lights) : lamps_(lamps), lights_(lights) {}

  /// Level by level; the levels of up to as many nodes as there are lamps are full, for nodes are
  /// halved by count.
  void build(std::span<std::uint32_t> members) {
    while (2U << lights_.tree_cluster_bits <=
           std::min<std::size_t>(members.size(), kMaxLightCandidates)) {
      ++lights_.tree_cluster_bits;
    }
    lights_.tree_trail.assign(lamps_.size(), kNoTrail);
    std::vector<Node> nodes{{members, 0, 0}};
    nodes.reserve(2 * members.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Node node = nodes[i];
      append_row(cluster_of(lamps_, node.members));
      if (node.members.size() == 1) {
        lights_.tree_child.push_back(kLightLeaf | node.members[0]);
        lights_.tree_trail[node.members[0]] = node.trail;
        continue;
      }
      lights_.tree_child.push_back(static_cast<std::uint32_t>(nodes.size()));
      const std::size_t half = split(node.members);
      nodes.push_back({node.members.first(half), first_half(node), node.depth + 1});
      nodes.push_back({node.members.subspan(half), second_half(node), node.depth + 1});
    }
  }

 private:
  struct Node {
    std::span<std::uint32_t> members;
    std::uint32_t trail;  ///< down to the clusters the number within the level, then a bit a turn
    int depth;
  };
  [[nodiscard]] std::uint32_t first_half(const Node& n) const {
    return n.depth < lights_.tree_cluster_bits ? 2 * n.trail : n.trail;
  }
  [[nodiscard]] std::uint32_t second_half(const Node& n) const {
    return n.depth < lights_.tree_cluster_bits ? 2 * n.trail + 1 : n.trail | 1U << n.depth;
  }

  void append_row(const Cluster& c) {
    const double sine = std::sqrt(std::max(0.0, 1 - c.cosine * c.cosine));
    const double numbers[kLightNodeStride] = {c.center.x, c.center.y, c.center.z,     c.radius,
                                              c.weight,   c.axis.x,   c.axis.y,       c.axis.z,
                                              c.cosine,   sine,       0.25 / c.radius};
    for (const double x : numbers) lights_.tree_rows.push_back(static_cast<T>(x));
  }

  std::size_t split(std::span<std::uint32_t> members) const {
    dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const std::uint32_t i : members) {
      low = glm::min(low, lamps_[i].place.center);
      high = glm::max(high, lamps_[i].place.center);
    }
    const dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::size_t half = members.size() / 2;
    std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half),
                     members.end(), [&](std::uint32_t a, std::uint32_t b) {
                       const double x = lamps_[a].place.center[axis],
                                    y = lamps_[b].place.center[axis];
                       return x != y ? x < y : a < b;
                     });
    return half;
  }

  const std::vector<Lamp>& lamps_;
  LightPart<T>& lights_;
};

}  // namespace

template <class T>
void add_light_tree(const std::vector<Lamp>& lamps, LightPart<T>& lights) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < lamps.size(); ++i) {
    if (lamps[i].weight > 0) members.push_back(i);
  }
  if (members.empty()) return;
  Builder<T>(lamps, lights).build(members);
}

template void add_light_tree(const std::vector<Lamp>&, LightPart<float>&);
template void add_light_tree(const std::vector<Lamp>&, LightPart<double>&);

}  // namespace lightbench
