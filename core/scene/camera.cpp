// Photographers' numbers for a camera stored as field of view and lens radius.

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "core/scene/scene.h"

namespace lightbench {

double focal_length(const Camera& camera) {
  return 0.5 * camera.sensor_height / std::tan(0.5 * glm::radians(camera.vfov));
}

double vfov_from_focal_length(double millimetres, double sensor_height) {
  return glm::degrees(2 * std::atan(0.5 * sensor_height / millimetres));
}

// The f-number is focal length over the diameter of the lens; 1 unit = 1 m = 1000 mm.
double f_stop(const Camera& camera) {
  if (camera.lens_radius == 0) return std::numeric_limits<double>::infinity();
  return focal_length(camera) / (2000 * camera.lens_radius);
}

double lens_radius_from_f_stop(double f_stop, double focal_length_mm) {
  return focal_length_mm / (2000 * f_stop);
}

}  // namespace lightbench
