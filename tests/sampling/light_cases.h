#pragma once
// Every shape as a light, seen from near, far, beside, along its axis, within its plane and inside.

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

struct LightCase {
  std::string name;
  Object object;  ///< a MeshShape means light_mesh()
  glm::dvec3 from;
};

/// Four triangles of unequal size that are neither closed nor in one plane.
Mesh light_mesh();

const std::vector<LightCase>& light_cases();

/// The object as the only thing in a scene, glowing on both sides.
Scene light_scene(const Object& object);

}  // namespace lightbench
