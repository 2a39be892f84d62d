#include "core/compile/walls.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <variant>

#include "core/scene/transform.h"

namespace lightbench {
namespace {

using glm::dvec3;

/// How far beyond a wall's plane another object may reach, in sizes of the scene: what transforms
/// in double leave of surfaces that touch.
constexpr double kRounding = 1e-13;

/// Two directions within the shape's plane; none if it is not flat.
struct PlaneOf {
  using Directions = std::optional<std::pair<dvec3, dvec3>>;
  Directions operator()(const RectangleShape& s) const { return {{s.edge_u, s.edge_v}}; }
  Directions operator()(const TriangleShape& s) const { return {{s.b - s.a, s.c - s.a}}; }
  Directions operator()(const DiscShape& s) const {
    const dvec3 n = glm::normalize(s.normal);
    const dvec3 u = cross(n, std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0));
    return {{u, cross(n, u)}};
  }
  Directions operator()(const auto&) const { return {}; }
};

}  // namespace

std::vector<bool> find_walls(const Scene& scene, const std::vector<std::uint8_t>& roles,
                             const std::vector<Bounds>& meshes) {
  std::vector<bool> walls(scene.objects.size());
  std::vector<glm::dmat4> to_world(scene.objects.size());
  double size = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (roles[i] == 0) continue;
    to_world[i] = object_to_world(scene.objects[i].transform);
    const Bounds b = shape_bounds(scene.objects[i].shape, to_world[i], scene.camera, meshes);
    for (int k = 0; k < 3; ++k) size = std::max({size, std::abs(b.min[k]), std::abs(b.max[k])});
  }
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (roles[i] == 0) continue;
    const auto plane = std::visit(PlaneOf{}, scene.objects[i].shape);
    if (!plane) continue;
    const dvec3 u(to_world[i] * glm::dvec4(plane->first, 0));
    const dvec3 v(to_world[i] * glm::dvec4(plane->second, 0));
    const dvec3 n = glm::normalize(cross(u, v));
    // The boxes' x is the height over the plane through the origin.
    const glm::dmat4 upright = glm::transpose(glm::dmat4(
        glm::dvec4(n, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1)));
    const auto heights = [&](std::size_t object) {
      return shape_bounds(scene.objects[object].shape, upright * to_world[object], scene.camera,
                          meshes);
    };
    const Bounds own = heights(i);
    const double rounding = kRounding * size;
    bool above = true, below = true;
    for (std::size_t other = 0; other < walls.size() && (above || below); ++other) {
      if (roles[other] == 0 || other == i) continue;
      const Bounds b = heights(other);
      above = above && b.min.x >= own.min.x - rounding;
      below = below && b.max.x <= own.max.x + rounding;
    }
    walls[i] = above || below;
  }
  return walls;
}

}  // namespace lightbench
