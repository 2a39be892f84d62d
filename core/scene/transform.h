#pragma once
// Transforms as matrices, in double: for compile(), the camera tools of the UI, and bounds.

#include <glm/mat4x4.hpp>

#include "core/scene/scene.h"

namespace lightbench {

/// Column vectors: world = matrix * object. Exact for the identity and for multiples of 90 degrees
/// about a coordinate axis.
glm::dmat4 object_to_world(const Transform& transform);

/// `matrix` applied to a point (with translation) or to a vector (without).
glm::dvec3 transform_point(const glm::dmat4& matrix, const glm::dvec3& point);
glm::dvec3 transform_vector(const glm::dmat4& matrix, const glm::dvec3& vector);

}  // namespace lightbench
