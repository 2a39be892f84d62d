#include "core/scene/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>

namespace lightbench {
namespace {

struct SineCosine {
  double sine;
  double cosine;
};

// Quarter turns are exact, so that a wall turned by 90 degrees still meets its neighbour.
SineCosine sine_cosine(double degrees) {
  const double quarters = std::nearbyint(degrees / 90);
  const double rest = glm::radians(degrees - 90 * quarters);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (static_cast<int>(std::fmod(quarters, 4.0))) {
    case 1:
    case -3:
      return {c, -s};
    case 2:
    case -2:
      return {-s, -c};
    case 3:
    case -1:
      return {-c, s};
    default:
      return {s, c};
  }
}

// Rodrigues' formula: columns are the images of the basis vectors.
glm::dmat3 rotation(const glm::dvec3& axis, double degrees) {
  // Scaled first so that neither tiny nor huge axes lose their squares.
  const glm::dvec3 size = glm::abs(axis);
  const glm::dvec3 a = glm::normalize(axis / std::max({size.x, size.y, size.z}));
  const auto [s, c] = sine_cosine(degrees);
  const glm::dvec3 t = (1 - c) * a;
  return {glm::dvec3(c + t.x * a.x, t.x * a.y + s * a.z, t.x * a.z - s * a.y),
          glm::dvec3(t.y * a.x - s * a.z, c + t.y * a.y, t.y * a.z + s * a.x),
          glm::dvec3(t.z * a.x + s * a.y, t.z * a.y - s * a.x, c + t.z * a.z)};
}

}  // namespace

glm::dmat4 object_to_world(const Transform& transform) {
  const glm::dmat3 turn = rotation(transform.axis, transform.degrees);
  return {glm::dvec4(turn[0] * transform.scale.x, 0), glm::dvec4(turn[1] * transform.scale.y, 0),
          glm::dvec4(turn[2] * transform.scale.z, 0), glm::dvec4(transform.translation, 1)};
}

glm::dvec3 transform_point(const glm::dmat4& matrix, const glm::dvec3& point) {
  return glm::dvec3(matrix * glm::dvec4(point, 1));
}

glm::dvec3 transform_vector(const glm::dmat4& matrix, const glm::dvec3& vector) {
  return glm::dvec3(matrix * glm::dvec4(vector, 0));
}

}  // namespace lightbench
