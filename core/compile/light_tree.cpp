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
  }
  return c;
}

template <class T>
class Builder {
 public:
  Builder(const std::vector<Lamp>& lamps, LightPart<T>& lights) : lamps_(lamps), lights_(lights) {}

  void build(std::span<std::uint32_t> members) {
    lights_.tree_trail.assign(lamps_.size(), kNoTrail);
    lights_.tree_rows.resize(kLightNodeStride);
    lights_.tree_child.resize(1);
    fill(0, members, 0, 0);
  }

 private:
  /// `trail` has a bit for each turn on the way to the node, the first one lowest.
  void fill(std::size_t node, std::span<std::uint32_t> members, std::uint32_t trail,
            unsigned depth) {
    const Cluster c = cluster_of(lamps_, members);
    const double sine = std::sqrt(std::max(0.0, 1 - c.cosine * c.cosine));
    const double numbers[kLightNodeStride] = {c.center.x, c.center.y, c.center.z,     c.radius,
                                              c.weight,   c.axis.x,   c.axis.y,       c.axis.z,
                                              c.cosine,   sine,       0.25 / c.radius};
    std::transform(std::begin(numbers), std::end(numbers),
                   lights_.tree_rows.begin() + static_cast<std::ptrdiff_t>(node * kLightNodeStride),
                   [](double x) { return static_cast<T>(x); });
    if (members.size() == 1) {
      lights_.tree_child[node] = kLightLeaf | members[0];
      lights_.tree_trail[members[0]] = trail;
      return;
    }
    const auto children = static_cast<std::uint32_t>(lights_.tree_child.size());
    lights_.tree_child[node] = children;
    lights_.tree_child.resize(children + 2U);
    lights_.tree_rows.resize(std::size_t{kLightNodeStride} * (children + 2U));
    const std::size_t half = split(members);
    fill(children, members.first(half), trail, depth + 1);
    fill(children + 1U, members.subspan(half), trail | 1U << depth, depth + 1);
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
