#include "app/stress/solid_angles.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "app/stress/quadrature.h"

namespace lightbench::stress {
namespace {

constexpr Number kPi = std::numbers::pi_v<Number>;

/// Van Oosterom and Strackee's, with the determinant from edges, which keeps it exact from afar.
Number triangle_angle(const V& from, const V& p, const V& q, const V& r) {
  const V a = p - from, b = q - from, c = r - from;
  const Number x = glm::length(a), y = glm::length(b), z = glm::length(c);
  const Number determinant = glm::dot(a, glm::cross(q - p, r - p));
  const Number below = x * y * z + glm::dot(a, b) * z + glm::dot(b, c) * x + glm::dot(c, a) * y;
  return 2 * std::abs(std::atan2(determinant, below));
}

Number parallelogram_angle(const V& from, const V& a, const V& u, const V& v) {
  return triangle_angle(from, a, a + u, a + u + v) + triangle_angle(from, a, a + u + v, a + v);
}

/// Of the ellipse with conjugate semi-axes u and v. By Stokes: the integral of n . (w x dw) /
/// (R (R + h)) along the rim, w from the point to the rim, R its length and h the point's height.
/// The rule is exact to the last bits for a smooth closed curve.
Number ellipse_angle(const V& from, const V& center, const V& u, const V& v) {
  constexpr int kPoints = 1024;
  const V n = glm::normalize(glm::cross(u, v)), f = center - from;
  const Number height = std::abs(glm::dot(f, n));
  const V level = f - glm::dot(f, n) * n;
  Number sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Number t = 2 * kPi * i / kPoints;
    const V w = level + std::cos(t) * u + std::sin(t) * v;
    const V along = std::cos(t) * v - std::sin(t) * u;
    const Number distance = std::sqrt(glm::dot(w, w) + height * height);
    sum += glm::dot(n, glm::cross(w, along)) / (distance * (distance + height));
  }
  return sum * 2 * kPi / kPoints;
}

/// The integral of 1 / |u + z v|^3 over z from 0 to `length`.
Number inverse_cubes(const V& u, const V& v, Number length) {
  const V end = u + length * v;
  const Number a = glm::dot(v, u), b = glm::dot(v, end);
  const Number x = glm::length(u), y = glm::length(end);
  // b / y - a / x over |u x v|^2, which would cancel if both have the same sign.
  if (a * b > 0) return length * (a + b) / (x * y * (b * x + a * y));
  const V across = glm::cross(u, v);
  return (b / y - a / x) / glm::dot(across, across);
}

struct SolidAngle {
  Matrix to_world;
  V from;

  [[nodiscard]] V point(const V& p) const { return V(to_world * glm::vec<4, Number>(p, 1)); }
  [[nodiscard]] V vector(const V& v) const { return V(to_world * glm::vec<4, Number>(v, 0)); }
  [[nodiscard]] V local_from() const {
    return V(glm::inverse(to_world) * glm::vec<4, Number>(from, 1));
  }
  [[nodiscard]] Number determinant() const {
    return std::abs(glm::determinant(glm::mat<3, 3, Number>(to_world)));
  }
  /// |M d|^-3 |det M| is the solid angle that the map makes of a unit one around the unit vector d.
  [[nodiscard]] Number growth(const V& d) const {
    const Number stretch = glm::length(vector(d));
    return determinant() / (stretch * stretch * stretch);
  }

  [[nodiscard]] Number disc_angle(const V& center, const V& normal, Number radius) const {
    const V n = glm::normalize(normal);
    const V u =
        radius * glm::normalize(glm::cross(n, std::abs(n.x) < 0.5 ? V(1, 0, 0) : V(0, 1, 0)));
    return ellipse_angle(from, point(center), vector(u), vector(glm::cross(n, u)));
  }
  /// Of the part of a cylinder's side that the point sees: cos / distance^2 over its surface, along
  /// the axis in closed form, around it by the midpoint rule in the angle's sine, which is smooth
  /// up to the outline.
  [[nodiscard]] Number side_angle(const V& p0, const V& p1, Number radius) const {
    constexpr int kPoints = 1024;
    const Number length = glm::distance(p0, p1);
    const V axis = (p1 - p0) / length, f = local_from();
    const V off = f - p0 - glm::dot(f - p0, axis) * axis;
    const Number rho = glm::length(off);
    if (rho <= radius) return 0;
    const V x = off / rho, y = glm::cross(axis, x), along = vector(axis);
    const Number end = std::acos(radius / rho);
    Number sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      const Number turn = kPi * ((i + Number(0.5)) / kPoints - Number(0.5));
      const Number angle = end * std::sin(turn);
      const V n = std::cos(angle) * x + std::sin(angle) * y;
      const Number facing = rho * std::cos(angle) - radius;
      sum += facing * inverse_cubes(vector(p0 + radius * n - f), along, length) * std::cos(turn);
    }
    return sum * determinant() * radius * end * kPi / kPoints;
  }

  Number operator()(const SphereShape& s) const {
    const auto radius = static_cast<Number>(s.radius);
    const V w = V(s.center) - local_from();
    const Number sine2 = radius * radius / glm::dot(w, w);
    const Number cap = sine2 / (1 + std::sqrt(1 - sine2));  // 1 - cos
    if (to_world == Matrix(1)) return 2 * kPi * cap;
    constexpr int kAround = 256;
    const V z = glm::normalize(w);
    const V x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.5 ? V(1, 0, 0) : V(0, 1, 0)));
    const V y = glm::cross(z, x);
    Number sum = 0;
    for (const auto& [node, weight] : gauss<48>()) {
      const Number drop = cap * node, sine = std::sqrt(drop * (2 - drop));
      for (int i = 0; i < kAround; ++i) {
        const Number phi = 2 * kPi * i / kAround;
        const V d = (1 - drop) * z + sine * (std::cos(phi) * x + std::sin(phi) * y);
        sum += static_cast<Number>(weight) * growth(d);
      }
    }
    return sum * cap * 2 * kPi / kAround;
  }
  Number operator()(const CylinderShape& s) const {
    const V p0(s.p0), p1(s.p1), axis = glm::normalize(p1 - p0), f = local_from();
    Number angle = side_angle(p0, p1, s.radius);
    if (glm::dot(f - p0, axis) < 0) angle += disc_angle(p0, axis, s.radius);
    if (glm::dot(f - p1, axis) > 0) angle += disc_angle(p1, axis, s.radius);
    return angle;
  }
  Number operator()(const DiscShape& s) const {
    return disc_angle(V(s.center), V(s.normal), s.radius);
  }
  Number operator()(const RectangleShape& s) const {
    return parallelogram_angle(from, point(V(s.corner)), vector(V(s.edge_u)), vector(V(s.edge_v)));
  }
  Number operator()(const TriangleShape& s) const {
    return triangle_angle(from, point(V(s.a)), point(V(s.b)), point(V(s.c)));
  }
  /// Every line from outside that meets a convex solid meets two of its faces.
  Number operator()(const PyramidShape& s) const {
    std::array<V, 4> v;
    for (std::size_t i = 0; i < 4; ++i) v[i] = point(V(s.vertices[i]));
    Number sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += triangle_angle(from, v[i], v[(i + 1) % 4], v[(i + 2) % 4]);
    }
    return sum / 2;
  }
  Number operator()(const BoxShape& s) const {
    const V low = point(V(s.min)), extent(V(s.max) - V(s.min));
    std::array<V, 3> edge;
    for (int k = 0; k < 3; ++k) {
      V along(0);
      along[k] = extent[k];
      edge[static_cast<std::size_t>(k)] = vector(along);
    }
    Number sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const V &u = edge[(k + 1) % 3], &v = edge[(k + 2) % 3];
      sum += parallelogram_angle(from, low, u, v) + parallelogram_angle(from, low + edge[k], u, v);
    }
    return sum / 2;
  }
  Number operator()(const MeshShape&) const { return 0; }
};

}  // namespace

Number solid_angle(const Shape& shape, const Matrix& to_world, const V& from) {
  return std::visit(SolidAngle{to_world, from}, shape);
}

}  // namespace lightbench::stress
