#include "ui/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

namespace lightbench::ui {
namespace {

constexpr double kPoleMargin = 1.0;  // degrees kept between the view and the up vector

glm::dvec3 rotated(const glm::dvec3& v, double degrees, const glm::dvec3& axis) {
  return {glm::rotate(glm::dmat4(1), glm::radians(degrees), axis) * glm::dvec4(v, 0)};
}

glm::dvec3 unit(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double length = glm::length(v);
  return length > 0 ? v / length : fallback;
}

/// The pitch that may be applied without crossing a pole.
double limited_pitch(const Camera& camera, double pitch) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 up = unit(camera.up, {0, 1, 0});
  const double elevation =
      glm::degrees(std::asin(std::clamp(glm::dot(axes.forward, up), -1.0, 1.0)));
  const double limit = 90 - kPoleMargin;
  return std::clamp(pitch, std::min(0.0, -limit - elevation), std::max(0.0, limit - elevation));
}

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  CameraAxes axes;
  axes.forward = unit(camera.look_at - camera.look_from, axes.forward);
  glm::dvec3 side = glm::cross(axes.forward, camera.up);
  if (glm::length(side) < 1e-9 * glm::length(camera.up)) {
    const glm::dvec3 other =
        std::abs(axes.forward.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    side = glm::cross(axes.forward, other);
  }
  axes.right = unit(side, axes.right);
  axes.up = glm::cross(axes.right, axes.forward);
  return axes;
}

Camera orbit(const Camera& camera, const glm::dvec3& pivot, double yaw, double pitch) {
  Camera result = camera;
  const double tilt = limited_pitch(camera, pitch);
  const glm::dvec3 right = camera_axes(camera).right;
  const glm::dvec3 up = unit(camera.up, {0, 1, 0});
  for (glm::dvec3* point : {&result.look_from, &result.look_at}) {
    *point = pivot + rotated(rotated(*point - pivot, tilt, right), yaw, up);
  }
  return result;
}

Camera pan(const Camera& camera, const glm::dvec2& delta, double distance) {
  const CameraAxes axes = camera_axes(camera);
  const double height = 2 * distance * std::tan(glm::radians(camera.vfov) / 2);
  const glm::dvec3 move = height * (delta.y * axes.up - delta.x * axes.right);
  Camera result = camera;
  result.look_from += move;
  result.look_at += move;
  return result;
}

Camera dolly(const Camera& camera, const glm::dvec3& pivot, double factor) {
  const double distance = glm::dot(pivot - camera.look_from, camera_axes(camera).forward);
  const double to_target = glm::length(camera.look_at - camera.look_from);
  // A pivot behind the camera says nothing about how far to go; the target does.
  const double reach = distance > 0 ? distance : to_target;
  const glm::dvec3 move = (1 - factor) * reach * camera_axes(camera).forward;
  Camera result = camera;
  result.look_from += move;
  // A camera that heads for another point than its target would pass that.
  if (pivot != camera.look_at) result.look_at += move;
  return result;
}

Camera look(const Camera& camera, double yaw, double pitch) {
  Camera result = orbit(camera, camera.look_from, yaw, pitch);
  result.look_from = camera.look_from;
  return result;
}

Camera fly(const Camera& camera, const glm::dvec3& step) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 move =
      step.x * axes.right + step.y * unit(camera.up, {0, 1, 0}) + step.z * axes.forward;
  Camera result = camera;
  result.look_from += move;
  result.look_at += move;
  return result;
}

Camera frame_bounds(const Camera& camera, const Bounds& bounds, double aspect) {
  if (bounds.empty()) return camera;
  const double half_vertical = glm::radians(camera.vfov) / 2;
  const double half_horizontal = std::atan(aspect * std::tan(half_vertical));
  const double radius = std::max(0.5 * glm::length(bounds.size()), 1e-6);
  const double distance = 1.05 * radius / std::sin(std::min(half_vertical, half_horizontal));
  Camera result = camera;
  result.look_at = bounds.center();
  result.look_from = result.look_at - distance * camera_axes(camera).forward;
  return result;
}

Camera focus_on(const Camera& camera, const glm::dvec3& point) {
  const double depth = glm::dot(point - camera.look_from, camera_axes(camera).forward);
  Camera result = camera;
  if (depth > 0) result.focus_distance = depth;
  return result;
}

std::optional<glm::dvec2> project(const Camera& camera, const glm::dvec2& size,
                                  const glm::dvec3& point) {
  const CameraAxes axes = camera_axes(camera);
  const glm::dvec3 offset = point - camera.look_from;
  const double depth = glm::dot(offset, axes.forward);
  if (depth <= 0) return std::nullopt;
  const double scale = 0.5 * size.y / (std::tan(glm::radians(camera.vfov) / 2) * depth);
  return glm::dvec2(0.5 * size.x + scale * glm::dot(offset, axes.right),
                    0.5 * size.y - scale * glm::dot(offset, axes.up));
}

}  // namespace lightbench::ui
