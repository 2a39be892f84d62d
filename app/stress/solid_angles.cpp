#include "app/stress/solid_angles.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

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

/// By Stokes: the integral of (x dy - y dx) / (R (R + h)) along the rim, x and y from the foot of
/// the point, R its distance and h its height. The rule is exact to the last bits for a smooth
/// closed curve.
Number disc_angle(const V& from, const V& center, const V& n, Number radius) {
  constexpr int kPoints = 1024;
  const V f = from - center;
  const Number height = std::abs(glm::dot(f, n));
  const Number foot = glm::length(f - glm::dot(f, n) * n);
  Number sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Number t = 2 * kPi * i / kPoints;
    const Number x = radius * std::cos(t) - foot, y = radius * std::sin(t);
    const Number distance = std::sqrt(x * x + y * y + height * height);
    sum += radius * (radius - foot * std::cos(t)) / (distance * (distance + height));
  }
  return sum * 2 * kPi / kPoints;
}

/// Of the part of a tube's side that a point sees: cos / distance^2 over its surface, along the
/// axis in closed form, around it by the midpoint rule in the angle's sine, which is smooth up to
/// the outline.
Number tube_angle(Number rho, Number low, Number high, Number radius) {
  if (rho <= radius) return 0;
  constexpr int kPoints = 1024;
  const Number end = std::acos(radius / rho);
  Number sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Number turn = kPi * ((i + Number(0.5)) / kPoints - Number(0.5));
    const Number angle = end * std::sin(turn);
    const Number facing = rho * std::cos(angle) - radius;
    const Number across2 = rho * rho + radius * radius - 2 * rho * radius * std::cos(angle);
    const Number a = std::sqrt(across2 + low * low), b = std::sqrt(across2 + high * high);
    // high / b - low / a, free of cancellation if both have the same sign.
    const Number sines =
        low * high > 0 ? across2 * (high - low) * (high + low) / (a * b * (high * a + low * b))
                       : high / b - low / a;
    sum += radius * facing / across2 * sines * end * std::cos(turn);
  }
  return sum * kPi / kPoints;
}

struct SolidAngle {
  V from;
  Number operator()(const SphereShape& s) const {
    const V w = V(s.center) - from;
    const Number sine2 = static_cast<Number>(s.radius) * s.radius / glm::dot(w, w);
    return 2 * kPi * sine2 / (1 + std::sqrt(1 - sine2));
  }
  Number operator()(const CylinderShape& s) const {
    const V p0(s.p0), p1(s.p1), axis = glm::normalize(p1 - p0);
    const Number low = glm::dot(p0 - from, axis), high = glm::dot(p1 - from, axis);
    const Number rho = glm::length(from - p0 + low * axis);
    Number angle = tube_angle(rho, low, high, s.radius);
    if (low > 0) angle += disc_angle(from, p0, axis, s.radius);
    if (high < 0) angle += disc_angle(from, p1, axis, s.radius);
    return angle;
  }
  Number operator()(const DiscShape& s) const {
    return disc_angle(from, V(s.center), glm::normalize(V(s.normal)), s.radius);
  }
  Number operator()(const RectangleShape& s) const {
    return parallelogram_angle(from, V(s.corner), V(s.edge_u), V(s.edge_v));
  }
  Number operator()(const TriangleShape& s) const {
    return triangle_angle(from, V(s.a), V(s.b), V(s.c));
  }
  /// Every line from outside that meets a convex solid meets two of its faces.
  Number operator()(const PyramidShape& s) const {
    const std::array<V, 4> v{V(s.vertices[0]), V(s.vertices[1]), V(s.vertices[2]),
                             V(s.vertices[3])};
    Number sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += triangle_angle(from, v[i], v[(i + 1) % 4], v[(i + 2) % 4]);
    }
    return sum / 2;
  }
  Number operator()(const BoxShape& s) const {
    const V low(s.min), edge(V(s.max) - V(s.min));
    Number sum = 0;
    for (int k = 0; k < 3; ++k) {
      V u(0), v(0), across(0);
      u[(k + 1) % 3] = edge[(k + 1) % 3];
      v[(k + 2) % 3] = edge[(k + 2) % 3];
      across[k] = edge[k];
      sum += parallelogram_angle(from, low, u, v) + parallelogram_angle(from, low + across, u, v);
    }
    return sum / 2;
  }
  Number operator()(const MeshShape&) const { return 0; }
};

}  // namespace

Number solid_angle(const Shape& shape, const V& from) {
  return std::visit(SolidAngle{from}, shape);
}

}  // namespace lightbench::stress
