#include "core/compile/scene_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <variant>

#include "core/compile/mesh_pieces.h"
#include "core/compile/surface_gaps.h"

namespace lightbench {
namespace {

std::string named(const std::string& object) {
  return object.empty() ? "an object without a name" : object;
}

double smallest_component(const glm::dvec3& v) { return std::min({v.x, v.y, v.z}); }
double largest_component(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Twice the area of a triangle over its longest side.
double altitude(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return glm::length(glm::cross(b - a, c - a)) / longest;
}

/// The smallest length that makes up a shape, in object space.
struct SmallestFeature {
  const decltype(SceneReach::pieces)& pieces;

  double operator()(const SphereShape& s) const { return s.radius; }
  double operator()(const CylinderShape& s) const {
    return std::min(s.radius, glm::distance(s.p0, s.p1));
  }
  double operator()(const DiscShape& s) const { return s.radius; }
  double operator()(const RectangleShape& s) const {
    const double longest = std::max(glm::length(s.edge_u), glm::length(s.edge_v));
    return glm::length(glm::cross(s.edge_u, s.edge_v)) / longest;
  }
  double operator()(const TriangleShape& s) const { return altitude(s.a, s.b, s.c); }
  double operator()(const PyramidShape& s) const {
    const auto& v = s.vertices;
    const double volume6 = std::abs(glm::dot(v[1] - v[0], glm::cross(v[2] - v[0], v[3] - v[0])));
    double area2 = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec3 a = v[(i + 1) % 4], b = v[(i + 2) % 4], c = v[(i + 3) % 4];
      area2 = std::max(area2, glm::length(glm::cross(b - a, c - a)));
    }
    return volume6 / area2;
  }
  double operator()(const BoxShape& s) const { return smallest_component(s.max - s.min); }
  double operator()(const MeshShape& s) const {
    return pieces[static_cast<std::size_t>(s.mesh)].second;
  }
};

decltype(SceneReach::pieces) pieces_of(const Scene& scene, const SceneReach* previous) {
  decltype(SceneReach::pieces) pieces;
  for (const MeshAsset& asset : scene.meshes) {
    const auto same = [&](const auto& known) { return known.first == asset.data; };
    if (previous != nullptr) {
      const auto known = std::find_if(previous->pieces.begin(), previous->pieces.end(), same);
      if (known != previous->pieces.end()) {
        pieces.push_back(*known);
        continue;
      }
    }
    // A mesh of one point, or of none, shows nothing that precision could keep.
    pieces.emplace_back(asset.data, asset.data == nullptr ? std::numeric_limits<double>::infinity()
                                                          : smallest_piece(*asset.data));
  }
  return pieces;
}

}  // namespace

std::vector<std::uint8_t> object_roles(const Scene& scene) {
  std::vector<std::uint8_t> roles(scene.objects.size());
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const Object& o = scene.objects[i];
    const int surface = o.visible && o.material != kNone ? 1 : 0;
    const int boundary = o.visible && o.medium != kNone ? 2 : 0;
    roles[i] = static_cast<std::uint8_t>(surface | boundary);
  }
  return roles;
}

SceneReach measure_reach(const Scene& scene, const SceneReach* previous) {
  SceneReach reach;
  reach.pieces = pieces_of(scene, previous);
  reach.shutter_open = scene.camera.shutter_open;
  reach.shutter_close = scene.camera.shutter_close;
  reach.roles = object_roles(scene);
  reach.smallest = std::numeric_limits<double>::infinity();
  const std::vector<Bounds> meshes = all_mesh_bounds(scene);
  // Fog around everything says nothing about where the surfaces are.
  std::vector<Bounds> surfaces;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (reach.roles[i] == 0) continue;
    if ((reach.roles[i] & 1) != 0) {
      surfaces.push_back(object_bounds(object, scene.camera, meshes));
    }
    const double feature = std::visit(SmallestFeature{reach.pieces}, object.shape) *
                           smallest_component(glm::abs(object.transform.scale));
    if (feature < reach.smallest) {
      reach.smallest = feature;
      reach.smallest_object = object.name;
    }
  }
  reach.center = middle_of(surfaces);
  for (const Bounds& b : surfaces) {
    if (b.empty()) continue;
    reach.farthest = std::max({reach.farthest, largest_component(glm::abs(b.min - reach.center)),
                               largest_component(glm::abs(b.max - reach.center))});
  }
  const double away = largest_component(glm::abs(reach.center)) + reach.farthest;
  // As close as transforms in double leave what is meant to coincide.
  const double contact = std::max(0x1p-40 * reach.farthest, 0x1p-48 * away);
  // Larger gaps are lost only to eyes for which the range asks for double anyway.
  const SurfaceGap gap = smallest_gap(scene, reach.roles, reach.center, contact,
                                      kFloatGap * kFloatRange * reach.smallest);
  reach.gap = gap.gap;
  if (std::isfinite(gap.gap)) {
    reach.gap_between = {scene.objects[gap.first].name, scene.objects[gap.second].name};
  }
  return reach;
}

namespace {

double eye_distance(const SceneReach& reach, const Camera& camera) {
  return std::max(reach.farthest, largest_component(glm::abs(camera.look_from - reach.center)));
}

}  // namespace

double range_of(const SceneReach& reach, const Camera& camera) {
  return std::isfinite(reach.smallest) ? eye_distance(reach, camera) / reach.smallest : 1;
}

Precision needed_precision(const SceneReach& reach, const Camera& camera) {
  const bool enough = range_of(reach, camera) <= kFloatRange &&
                      !(reach.gap < kFloatGap * eye_distance(reach, camera));
  return enough ? Precision::Float : Precision::Double;
}

std::string precision_reason(const SceneReach& reach, const Camera& camera) {
  const double range = range_of(reach, camera);
  if (range <= kFloatRange && needed_precision(reach, camera) == Precision::Double) {
    return fmt::format(
        "the surfaces of {} and {} are {:.3g} apart, seen from {:.3g}; float tells "
        "them apart down to {:.3g}",
        named(reach.gap_between[0]), named(reach.gap_between[1]), reach.gap,
        eye_distance(reach, camera), kFloatGap * eye_distance(reach, camera));
  }
  if (!std::isfinite(reach.smallest)) return "nothing to see";
  return fmt::format(
      "the scene reaches {:.3g} times as far as its smallest feature ({}); float does up to {:.0f}",
      range, named(reach.smallest_object), kFloatRange);
}

}  // namespace lightbench
