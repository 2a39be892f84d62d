#pragma once
// Moving the camera: pure functions on Camera, so that every gesture is a unit test. Lengths are in
// scene units; x to the right and y down in the picture, as the mouse reports them.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/scene/bounds.h"
#include "core/scene/scene.h"

namespace lightbench::ui {

/// Orthonormal view axes; `forward` points into the picture.
struct CameraAxes {
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 forward{0, 0, -1};
};
CameraAxes camera_axes(const Camera& camera);

/// Turns the camera about `pivot`: `yaw` about the up vector, `pitch` about the right axis,
/// degrees. Stops short of looking along the up vector, where left and right would swap.
Camera orbit(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch);

/// Moves camera and target so that what is `distance` away follows the mouse; `delta` is the move
/// in picture heights.
Camera pan(const Camera& camera, const glm::dvec2& delta, double distance);

/// Scales the distance to `pivot` by `factor` (> 0), keeping the view direction.
Camera dolly(const Camera& camera, const glm::dvec3& pivot, double factor);

/// Looks around from where the camera stands; angles in degrees, as for orbit.
Camera look(const Camera& camera, double yaw, double pitch);

/// Moves by `step` along right, up (the camera's up vector) and forward.
Camera fly(const Camera& camera, const glm::dvec3& step);

/// Moves back or forth until `bounds` fits the picture, and looks at its centre. `aspect` is width
/// over height. Unchanged if the box is empty.
Camera frame_bounds(const Camera& camera, const Bounds& bounds, double aspect);

/// Focuses on the plane through `point`; unchanged if the point is behind the camera.
Camera focus_on(const Camera& camera, const glm::dvec3& point);

/// Where a point falls in a picture of `size` pixels, or null behind the camera.
std::optional<glm::dvec2> project(const Camera& camera, const glm::dvec2& size,
                                  const glm::dvec3& point);

}  // namespace lightbench::ui
