#pragma once
// Parallelogram corner + a u + b v; a rectangle when the edges are perpendicular.

#include "core/sampling/spherical_parallelogram.h"
#include "core/shapes/disc.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

struct Rectangle {
  static constexpr unsigned kRow = 18;
  Vec corner, n, u, v;  ///< edges; n unit along u x v
  Vec dual_u, dual_v;   ///< dual_u . (p - corner) is the first coordinate
};

inline Rectangle rectangle_at(const auto& row) {
  return {row.vec(0), row.vec(3), row.vec(6), row.vec(9), row.vec(12), row.vec(15)};
}

inline PlaneHit hit_rectangle(const Rectangle& s, const Ray& ray) {
  const Real t = distance_to_plane(s.corner, s.n, ray);
  const Vec q = madd(ray.d, t, ray.o - s.corner);
  const Real a = dot(q, s.dual_u), b = dot(q, s.dual_v);
  return {t, min(a, b) >= Real(0) && max(a, b) <= Real(1)};
}

inline Surface surface_rectangle(const Rectangle& s, const Ray& ray, Real t, Coordinates uv) {
  const Vec q = madd(ray.d, t, ray.o - s.corner);
  Surface r;
  r.u = clamp(dot(q, s.dual_u), Real(0), Real(1));
  r.v = clamp(dot(q, s.dual_v), Real(0), Real(1));
  r.p = madd(s.u, r.u, madd(s.v, r.v, s.corner));
  r.ng = s.n;
  r.ns = s.n;
  if (uv == Coordinates::Wanted) r.tangent = normalize(s.u);
  return r;
}

inline SphericalParallelogram view_rectangle(const Rectangle& s, Vec from) {
  const Vec corner = s.corner - from;
  return spherical_parallelogram(corner, difference_error(s.corner, from, corner), s.u, s.v);
}

/// Uniform over the solid angle.
inline LightSample sample_rectangle(const Rectangle& s, Vec from, Vec2 u) {
  const SphericalParallelogram q = view_rectangle(s, from);
  const Vec d = sample_spherical_parallelogram(q, u.x * q.half, u.y);
  return toward_plane(d, q.corner, s.n, T(0.5) / q.half);
}

inline Real pdf_rectangle(const Rectangle& s, Vec from) {
  return T(0.5) / view_rectangle(s, from).half;
}

LIGHTBENCH_KERNEL_END
