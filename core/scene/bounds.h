#pragma once
// Axis-aligned boxes of shapes, objects and the scene, in double. The UI frames objects with them;
// compile() chooses render space from them.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

/// Empty until something is added.
struct Bounds {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(min.x <= max.x); }
  /// Of a box that is not empty.
  [[nodiscard]] glm::dvec3 center() const { return min + 0.5 * (max - min); }
  [[nodiscard]] glm::dvec3 size() const { return max - min; }
  void add(const glm::dvec3& point);
  void add(const Bounds& other);
};

/// The box of the mesh's positions.
Bounds mesh_bounds(const Mesh& mesh);
/// mesh_bounds of each of scene.meshes; empty where there is no data.
std::vector<Bounds> all_mesh_bounds(const Scene& scene);

/// Box of `shape` after `matrix` (affine), over the whole shutter. Tight for every shape but a
/// mesh, whose transformed box is bounded instead of its vertices. `meshes` is what all_mesh_bounds
/// gives.
Bounds shape_bounds(const Shape& shape, const glm::dmat4& matrix, const Camera& shutter,
                    const std::vector<Bounds>& meshes);

/// In world space; `meshes` is what all_mesh_bounds gives.
Bounds object_bounds(const Object& object, const Camera& shutter,
                     const std::vector<Bounds>& meshes);

/// World-space box of the visible objects; empty if there are none.
Bounds scene_bounds(const Scene& scene);

}  // namespace lightbench
