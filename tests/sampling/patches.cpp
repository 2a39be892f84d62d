#include "tests/sampling/patches.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench {
namespace {

using glm::dvec3;
constexpr double kTurn = 2 * std::numbers::pi;

/// Coordinates of q on perpendicular or skew axes e1, e2 of its plane.
void plane_coordinates(const dvec3& q, const dvec3& e1, const dvec3& e2, double& x, double& y) {
  const double a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), f = dot(q, e1), g = dot(q, e2);
  x = (f * c - g * b) / (a * c - b * b);
  y = (g * a - f * b) / (a * c - b * b);
}

double turn_of(double y, double x) {
  const double b = std::atan2(y, x) / kTurn;
  return b - std::floor(b);
}

double inside(double x) { return std::clamp(x, 0.0, std::nextafter(1.0, 0.0)); }

Patch triangle(const dvec3& a, const dvec3& b, const dvec3& c, int index = 0) {
  return {Patch::Kind::Triangle, a, b - a, c - a, dvec3(0), index};
}

}  // namespace

dvec3 Patch::point(double a, double b) const {
  const double x = std::cos(kTurn * b), y = std::sin(kTurn * b);
  switch (kind) {
    case Kind::Sphere: {
      const double z = 2 * a - 1, r = std::sqrt(1 - z * z);
      return origin + z * e1 + r * x * e2 + r * y * e3;
    }
    case Kind::Tube:
      return origin + (2 * a - 1) * e1 + x * e2 + y * e3;
    case Kind::Disc:
      return origin + std::sqrt(a) * (x * e1 + y * e2);
    case Kind::Parallelogram:
      return origin + a * e1 + b * e2;
    case Kind::Triangle:
      return origin + std::sqrt(a) * ((1 - b) * e1 + b * e2);
  }
  return origin;
}

double Patch::locate(const dvec3& p, double& a, double& b) const {
  const dvec3 q = p - origin;
  double x, y;
  switch (kind) {
    case Kind::Sphere:
      a = 0.5 * (dot(q, e1) / dot(e1, e1) + 1);
      b = turn_of(dot(q, e3), dot(q, e2));
      break;
    case Kind::Tube:
      a = 0.5 * (dot(q, e1) / dot(e1, e1) + 1);
      b = turn_of(dot(q, e3), dot(q, e2));
      break;
    case Kind::Disc:
      plane_coordinates(q, e1, e2, x, y);
      a = x * x + y * y;
      b = turn_of(y, x);
      break;
    case Kind::Parallelogram:
      plane_coordinates(q, e1, e2, a, b);
      break;
    case Kind::Triangle:
      plane_coordinates(q, e1, e2, x, y);
      x = std::max(x, 0.0);
      y = std::max(y, 0.0);
      a = (x + y) * (x + y);
      b = x + y > 0 ? y / (x + y) : 0;
      break;
  }
  a = inside(a);
  b = inside(b);
  return length(point(a, b) - p);
}

std::vector<Patch> patches_of(const Shape& shape, const Mesh& mesh) {
  using K = Patch::Kind;
  const dvec3 none(0);
  if (const auto* s = std::get_if<SphereShape>(&shape)) {
    const double r = s->radius;
    return {{K::Sphere, s->center, {0, r, 0}, {r, 0, 0}, {0, 0, r}}};
  }
  if (const auto* s = std::get_if<CylinderShape>(&shape)) {
    const dvec3 axis = normalize(s->p1 - s->p0);
    const dvec3 u = s->radius * normalize(cross(axis, dvec3(0.36, 0.48, 0.8)));
    const dvec3 v = cross(axis, u);
    return {{K::Tube, 0.5 * (s->p0 + s->p1), 0.5 * (s->p1 - s->p0), u, v},
            {K::Disc, s->p0, u, v, none},
            {K::Disc, s->p1, u, v, none}};
  }
  if (const auto* s = std::get_if<DiscShape>(&shape)) {
    const dvec3 n = normalize(s->normal);
    const dvec3 u = s->radius * normalize(cross(n, dvec3(0.36, 0.48, 0.8)));
    return {{K::Disc, s->center, u, cross(n, u), none}};
  }
  if (const auto* s = std::get_if<RectangleShape>(&shape)) {
    return {{K::Parallelogram, s->corner, s->edge_u, s->edge_v, none}};
  }
  if (const auto* s = std::get_if<TriangleShape>(&shape)) return {triangle(s->a, s->b, s->c)};
  if (const auto* s = std::get_if<PyramidShape>(&shape)) {
    const auto& v = s->vertices;
    return {triangle(v[0], v[1], v[2]), triangle(v[0], v[1], v[3]), triangle(v[0], v[2], v[3]),
            triangle(v[1], v[2], v[3])};
  }
  std::vector<Patch> r;
  if (const auto* s = std::get_if<BoxShape>(&shape)) {
    const dvec3 d = s->max - s->min;
    for (int k = 0; k < 3; ++k) {
      dvec3 e1(0), e2(0), across(0);
      e1[(k + 1) % 3] = d[(k + 1) % 3];
      e2[(k + 2) % 3] = d[(k + 2) % 3];
      across[k] = d[k];
      r.push_back({K::Parallelogram, s->min, e1, e2, none});
      r.push_back({K::Parallelogram, s->min + across, e1, e2, none});
    }
    return r;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    r.push_back(triangle(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]],
                         static_cast<int>(i)));
  }
  return r;
}

}  // namespace lightbench
