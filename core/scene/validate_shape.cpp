#include <cmath>
#include <glm/geometric.hpp>

#include "core/scene/validate.h"

namespace lightbench {
namespace {

// Flatter than this, the normal is rounding noise.
constexpr double kFlat = 1e-12;

bool parallel(const glm::dvec3& a, const glm::dvec3& b) {
  return !(glm::length(glm::cross(a, b)) > kFlat * glm::length(a) * glm::length(b));
}

bool coplanar(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return !(std::abs(glm::dot(glm::cross(a, b), c)) >
           kFlat * glm::length(a) * glm::length(b) * glm::length(c));
}

struct ValidateShape {
  const Place& place;
  std::size_t mesh_count;

  void operator()(const SphereShape& s) const {
    check_point(place / "/center", s.center);
    check_positive_length(place / "/radius", s.radius);
    check_point(place / "/motion", s.motion);
  }
  void operator()(const CylinderShape& s) const {
    check_point(place / "/p0", s.p0);
    check_point(place / "/p1", s.p1);
    if (!(glm::length(s.p1 - s.p0) >= kSmallestLength))
      out_of_range(place / "/p1", "a point other than p0", to_text(s.p1));
    check_positive_length(place / "/radius", s.radius);
  }
  void operator()(const DiscShape& s) const {
    check_point(place / "/center", s.center);
    check_direction(place / "/normal", s.normal);
    check_positive_length(place / "/radius", s.radius);
  }
  void operator()(const RectangleShape& s) const {
    check_point(place / "/corner", s.corner);
    check_direction(place / "/edgeU", s.edge_u);
    check_direction(place / "/edgeV", s.edge_v);
    if (parallel(s.edge_u, s.edge_v))
      out_of_range(place / "/edgeV", "an edge not parallel to edgeU", to_text(s.edge_v));
  }
  void operator()(const TriangleShape& s) const {
    check_point(place / "/a", s.a);
    check_point(place / "/b", s.b);
    check_point(place / "/c", s.c);
    if (!(glm::length(s.b - s.a) >= kSmallestLength))
      out_of_range(place / "/b", "a point other than a", to_text(s.b));
    if (!(glm::length(s.c - s.a) >= kSmallestLength) || parallel(s.b - s.a, s.c - s.a))
      out_of_range(place / "/c", "a point off the line through a and b", to_text(s.c));
  }
  void operator()(const PyramidShape& s) const {
    const Place vertices = place / "/vertices";
    for (const glm::dvec3& vertex : s.vertices) check_point(vertices, vertex);
    const auto& [a, b, c, d] = s.vertices;
    for (const glm::dvec3& edge : {b - a, c - a, d - a, c - b, d - b, d - c}) {
      if (!(glm::length(edge) >= kSmallestLength))
        out_of_range(vertices, "4 different points", "two that coincide");
    }
    if (coplanar(b - a, c - a, d - a))
      out_of_range(vertices, "4 points that enclose a volume", "4 points in a plane");
  }
  void operator()(const BoxShape& s) const {
    check_point(place / "/min", s.min);
    check_point(place / "/max", s.max);
    for (int axis = 0; axis < 3; ++axis) {
      if (!(s.max[axis] - s.min[axis] >= kSmallestLength))
        out_of_range(place / "/max", "every component above that of min " + to_text(s.min),
                     to_text(s.max));
    }
  }
  void operator()(const MeshShape& s) const {
    if (s.mesh < 0 || static_cast<std::size_t>(s.mesh) >= mesh_count)
      out_of_range(place / "/mesh", "the index of a mesh", std::to_string(s.mesh));
  }
};

bool usable(const glm::dvec3& v) {
  // One comparison each: false for NaN as well.
  return std::abs(v.x) <= kLargestLength && std::abs(v.y) <= kLargestLength &&
         std::abs(v.z) <= kLargestLength;
}

}  // namespace

void validate_shape(const Place& place, const Shape& shape, std::size_t mesh_count) {
  std::visit(ValidateShape{place, mesh_count}, shape);
}

bool is_closed(const Shape& shape) {
  return !std::holds_alternative<DiscShape>(shape) &&
         !std::holds_alternative<RectangleShape>(shape) &&
         !std::holds_alternative<TriangleShape>(shape);
}

void validate_mesh(const Place& place, const Mesh& mesh) {
  const auto count = mesh.positions.size();
  const auto element = [](std::size_t i) { return " (element " + std::to_string(i) + ")"; };
  if (mesh.triangles.empty())
    out_of_range(place / "/triangles", "at least one triangle", "an empty mesh");
  for (std::size_t i = 0; i < count; ++i) {
    if (!usable(mesh.positions[i]))
      out_of_range(place / "/positions", "finite components of at most 1e+18",
                   to_text(mesh.positions[i]) + element(i));
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t index : mesh.triangles[i]) {
      if (index >= count)
        out_of_range(place / "/triangles", "indices below " + std::to_string(count),
                     std::to_string(index) + element(i));
    }
  }
  if (!mesh.normals.empty() && mesh.normals.size() != count)
    out_of_range(place / "/normals", "one per position (" + std::to_string(count) + ")",
                 std::to_string(mesh.normals.size()));
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (!(std::abs(glm::dot(mesh.normals[i], mesh.normals[i]) - 1) < 0.01))
      out_of_range(place / "/normals", "vectors of length 1",
                   to_text(mesh.normals[i]) + element(i));
  }
  if (!mesh.uvs.empty() && mesh.uvs.size() != count)
    out_of_range(place / "/uvs", "one per position (" + std::to_string(count) + ")",
                 std::to_string(mesh.uvs.size()));
  for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
    if (!usable({mesh.uvs[i].x, mesh.uvs[i].y, 0}))
      out_of_range(place / "/uvs", "finite components of at most 1e+18",
                   to_text({mesh.uvs[i].x, mesh.uvs[i].y, 0}) + element(i));
  }
}

}  // namespace lightbench
