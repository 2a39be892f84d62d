#include "tests/transport/shape_patches.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>

#include "core/scene/transform.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPi = std::numbers::pi;

dvec3 place(const Transform& t, const dvec3& p) {
  return dvec3(object_to_world(t) * glm::dvec4(p, 1));
}

}  // namespace

std::vector<dvec3> place_all(const Transform& t, std::vector<dvec3> points) {
  for (dvec3& p : points) p = place(t, p);
  return points;
}

EmittingPatch sphere_patch(const SphereShape& s, const Transform& t) {
  return {[=](dvec2 u) {
    const double z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0, 1 - z * z)), phi = 2 * kPi * u.y;
    return place(t, s.center + s.radius * dvec3(r * std::cos(phi), r * std::sin(phi), z));
  }};
}

/// Rings of equal area.
EmittingPatch disc_patch(const dvec3& center, const dvec3& normal, double radius,
                         const Transform& t) {
  const dvec3 n = glm::normalize(normal);
  const dvec3 a =
      glm::normalize(glm::cross(n, std::abs(n.x) > 0.6 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  const dvec3 b = glm::cross(n, a);
  return {[=](dvec2 u) {
    const double r = radius * std::sqrt(std::max(0.0, u.x)), phi = 2 * kPi * u.y;
    return place(t, center + a * (r * std::cos(phi)) + b * (r * std::sin(phi)));
  }};
}

std::vector<EmittingPatch> cylinder_patches(const CylinderShape& c, const Transform& t) {
  const dvec3 axis = glm::normalize(c.p1 - c.p0);
  const dvec3 a = glm::normalize(glm::cross(axis, dvec3(0.3, 0.5, 0.9)));
  const dvec3 b = glm::cross(axis, a);
  const EmittingPatch side{[=](dvec2 u) {
    const double phi = 2 * kPi * u.x;
    return place(t,
                 c.p0 + (c.p1 - c.p0) * u.y + c.radius * (a * std::cos(phi) + b * std::sin(phi)));
  }};
  return {side, disc_patch(c.p0, -axis, c.radius, t), disc_patch(c.p1, axis, c.radius, t)};
}

std::vector<std::vector<dvec3>> box_faces(const BoxShape& box, const Transform& t) {
  const auto corner = [&](int i) {
    return dvec3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                 i & 4 ? box.max.z : box.min.z);
  };
  const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  std::vector<std::vector<dvec3>> result;
  for (const auto& f : faces) {
    result.push_back(place_all(t, {corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])}));
  }
  return result;
}

std::vector<std::vector<dvec3>> pyramid_faces(const PyramidShape& p, const Transform& t) {
  const dvec3 middle =
      place(t, 0.25 * (p.vertices[0] + p.vertices[1] + p.vertices[2] + p.vertices[3]));
  const std::size_t faces[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  std::vector<std::vector<dvec3>> result;
  for (const auto& f : faces) {
    std::vector<dvec3> c = place_all(t, {p.vertices[f[0]], p.vertices[f[1]], p.vertices[f[2]]});
    if (glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), c[0] - middle) < 0) std::swap(c[1], c[2]);
    result.push_back(c);
  }
  return result;
}

}  // namespace lightbench
