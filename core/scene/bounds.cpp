#include "core/scene/bounds.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <utility>

#include "core/scene/transform.h"

namespace lightbench {
namespace {

Bounds around(const glm::dvec3& center, const glm::dvec3& half) {
  return {center - half, center + half};
}

/// Two unit vectors that span the plane across `normal`.
std::pair<glm::dvec3, glm::dvec3> plane(const glm::dvec3& normal) {
  const glm::dvec3 n = glm::normalize(normal);
  const glm::dvec3 away = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(n, away));
  return {u, glm::cross(n, u)};
}

// A disc maps to an ellipse a cos t + b sin t: its half extent along an axis is hypot(a, b) there.
Bounds disc_bounds(const glm::dvec3& center, const glm::dvec3& normal, double radius,
                   const glm::dmat4& matrix) {
  const auto [u, v] = plane(normal);
  const glm::dvec3 a = transform_vector(matrix, radius * u);
  const glm::dvec3 b = transform_vector(matrix, radius * v);
  return around(transform_point(matrix, center), glm::sqrt(a * a + b * b));
}

Bounds box_bounds(const Bounds& box, const glm::dmat4& matrix) {
  Bounds result;
  for (int corner = 0; corner < 8; ++corner) {
    result.add(transform_point(matrix, glm::dvec3((corner & 1) != 0 ? box.max.x : box.min.x,
                                                  (corner & 2) != 0 ? box.max.y : box.min.y,
                                                  (corner & 4) != 0 ? box.max.z : box.min.z)));
  }
  return result;
}

struct ShapeBounds {
  const glm::dmat4& matrix;
  const Camera& shutter;
  const std::vector<Bounds>& meshes;

  Bounds operator()(const SphereShape& s) const {
    // The image of a sphere reaches as far along an axis as the length of that row of the matrix.
    const glm::dmat3 rows = glm::transpose(glm::dmat3(matrix));
    const glm::dvec3 half =
        s.radius * glm::dvec3(glm::length(rows[0]), glm::length(rows[1]), glm::length(rows[2]));
    Bounds result =
        around(transform_point(matrix, s.center + shutter.shutter_open * s.motion), half);
    result.add(around(transform_point(matrix, s.center + shutter.shutter_close * s.motion), half));
    return result;
  }
  Bounds operator()(const CylinderShape& s) const {
    Bounds result = disc_bounds(s.p0, s.p1 - s.p0, s.radius, matrix);
    result.add(disc_bounds(s.p1, s.p1 - s.p0, s.radius, matrix));
    return result;
  }
  Bounds operator()(const DiscShape& s) const {
    return disc_bounds(s.center, s.normal, s.radius, matrix);
  }
  Bounds operator()(const RectangleShape& s) const {
    Bounds result;
    for (const glm::dvec3& edge : {glm::dvec3(0), s.edge_u, s.edge_v, s.edge_u + s.edge_v})
      result.add(transform_point(matrix, s.corner + edge));
    return result;
  }
  Bounds operator()(const TriangleShape& s) const {
    Bounds result;
    for (const glm::dvec3& vertex : {s.a, s.b, s.c}) result.add(transform_point(matrix, vertex));
    return result;
  }
  Bounds operator()(const PyramidShape& s) const {
    Bounds result;
    for (const glm::dvec3& vertex : s.vertices) result.add(transform_point(matrix, vertex));
    return result;
  }
  Bounds operator()(const BoxShape& s) const { return box_bounds({s.min, s.max}, matrix); }
  Bounds operator()(const MeshShape& s) const {
    if (s.mesh < 0 || static_cast<std::size_t>(s.mesh) >= meshes.size()) return {};
    const Bounds& box = meshes[static_cast<std::size_t>(s.mesh)];
    return box.empty() ? Bounds{} : box_bounds(box, matrix);
  }
};

}  // namespace

void Bounds::add(const glm::dvec3& point) {
  min = glm::min(min, point);
  max = glm::max(max, point);
}

void Bounds::add(const Bounds& other) {
  min = glm::min(min, other.min);
  max = glm::max(max, other.max);
}

Bounds mesh_bounds(const Mesh& mesh) {
  Bounds result;
  for (const glm::dvec3& position : mesh.positions) result.add(position);
  return result;
}

std::vector<Bounds> all_mesh_bounds(const Scene& scene) {
  std::vector<Bounds> result;
  result.reserve(scene.meshes.size());
  for (const MeshAsset& mesh : scene.meshes)
    result.push_back(mesh.data ? mesh_bounds(*mesh.data) : Bounds{});
  return result;
}

Bounds shape_bounds(const Shape& shape, const glm::dmat4& matrix, const Camera& shutter,
                    const std::vector<Bounds>& meshes) {
  return std::visit(ShapeBounds{matrix, shutter, meshes}, shape);
}

Bounds object_bounds(const Object& object, const Camera& shutter,
                     const std::vector<Bounds>& meshes) {
  return shape_bounds(object.shape, object_to_world(object.transform), shutter, meshes);
}

Bounds scene_bounds(const Scene& scene) {
  const std::vector<Bounds> meshes = all_mesh_bounds(scene);
  Bounds result;
  for (const Object& object : scene.objects)
    if (object.visible) result.add(object_bounds(object, scene.camera, meshes));
  return result;
}

}  // namespace lightbench
