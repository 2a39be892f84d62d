#pragma once
// Parallelogram corner + a u + b v; a rectangle when the edges are perpendicular.

#include "core/sampling/spherical_rectangle.h"
#include "core/shapes/disc.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

struct Rectangle {
  static constexpr unsigned kRow = 18;
  Vec corner, n, u, v;  ///< edges; n unit along u x v
  Vec dual_u, dual_v;   ///< dual_u . (p - corner) is the first coordinate
};

inline Rectangle rectangle_at(const Row& row) {
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

inline Real area_of_rectangle(const Rectangle& s) { return length(cross(s.u, s.v)); }

/// True where the solid angle is sampled (near, and a true rectangle); sample and pdf share this.
inline Mask rectangle_is_near(const Rectangle& s, const SphericalRectangle& q) {
  const Real skew = abs(dot(s.u, s.v));
  return q.solid_angle > Real(kMinSolidAngle) &&
         skew <= T(1e-6) * (length_squared(s.u) + length_squared(s.v));
}

inline LightSample sample_rectangle(const Rectangle& s, Vec from, Vec2 u) {
  LightSample r = toward_point(from, madd(s.u, u.x, madd(s.v, u.y, s.corner)), s.n,
                               Real(1) / area_of_rectangle(s));
  const SphericalRectangle q = spherical_rectangle(from, s.corner, s.u, s.v);
  const Mask near = rectangle_is_near(s, q);
  if (any(near)) {
    const Vec w = sample_spherical_rectangle(q, u);
    const Real d = length(w);
    r.d = select(near, w * (Real(1) / d), r.d);
    r.distance = select(near, d, r.distance);
    r.pdf = select(near, Real(1) / q.solid_angle, r.pdf);
    r.valid = near || r.valid;
  }
  return r;
}

inline Real pdf_rectangle(const Rectangle& s, Vec from, Vec d, Real t) {
  const SphericalRectangle q = spherical_rectangle(from, s.corner, s.u, s.v);
  return select(rectangle_is_near(s, q), Real(1) / q.solid_angle,
                solid_angle_pdf(Real(1) / area_of_rectangle(s), t * t, abs(dot(s.n, d))));
}

LIGHTBENCH_KERNEL_END
