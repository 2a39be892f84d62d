#pragma once
// Disc with any centre, normal and radius; an ellipse when its object is scaled unevenly. Its two
// semi-axes are perpendicular (compile() sees to that).

#include "core/sampling/spherical_rectangle.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

struct Disc {
  static constexpr unsigned kRow = 18;
  Vec center, n, u, v;  ///< u x v points along n
  Vec dual_u, dual_v;   ///< dual_u . (p - center) is the first coordinate
};

inline Disc disc_at(const Row& row) {
  return {row.vec(0), row.vec(3), row.vec(6), row.vec(9), row.vec(12), row.vec(15)};
}

/// Ray parameter at the plane through `point`. A parallel ray gives infinity or NaN, and so do the
/// hit's coordinates then: every comparison with them fails, and the ray misses.
inline Real distance_to_plane(Vec point, Vec n, const Ray& ray) {
  return dot(n, point - ray.o) / dot(n, ray.d);
}

/// Coordinates of the hit on the semi-axes; on the unit disk inside the rim.
inline Vec2 disc_coordinates(const Disc& s, const Ray& ray, Real t) {
  const Vec q = madd(ray.d, t, ray.o - s.center);
  return {dot(q, s.dual_u), dot(q, s.dual_v)};
}

inline PlaneHit hit_disc(const Disc& s, const Ray& ray) {
  const Real t = distance_to_plane(s.center, s.n, ray);
  const Vec2 c = disc_coordinates(s, ray, t);
  return {t, fma(c.x, c.x, c.y * c.y) <= Real(1)};
}

/// uv: u around the normal, v the share of the radius.
inline Surface surface_disc(const Disc& s, const Ray& ray, Real t, Coordinates uv) {
  const Vec2 c = disc_coordinates(s, ray, t);
  Surface r;
  r.p = madd(s.u, c.x, madd(s.v, c.y, s.center));
  r.ng = s.n;
  r.ns = s.n;
  if (uv == Coordinates::None) return r;
  r.u = atan2(c.y, c.x) * (kInvPi * T(0.5)) + Real(T(0.5));
  r.v = sqrt(c.x * c.x + c.y * c.y);
  const Vec around = s.v * c.x - s.u * c.y;
  r.tangent = normalize(select(length_squared(around) > Real(0), around, s.v));
  return r;
}

/// The rectangle around the disc, whose solid angle is sampled when it is near: directions that
/// miss the disc are invalid (at most 1 - pi/4 of a rectangle seen face on), pdf = 1 / solid angle.
inline SphericalRectangle square_around(const Disc& s, Vec from) {
  return spherical_rectangle(from, s.center - s.u - s.v, s.u * Real(2), s.v * Real(2));
}

inline Real area_of_disc(const Disc& s) { return kPi * length(s.u) * length(s.v); }

/// Beyond this many (larger) radii the disc is sampled by area: misses would cost more than the
/// square gains.
inline constexpr T kDiscNear = T(1.5);

inline Mask disc_may_be_near(const Disc& s, Vec from) {
  return length_squared(from - s.center) <
         kDiscNear * kDiscNear * max(length_squared(s.u), length_squared(s.v));
}

inline LightSample sample_disc(const Disc& s, Vec from, Vec2 u) {
  const Vec2 k = square_to_disk(u);
  LightSample r =
      toward_point(from, madd(s.u, k.x, madd(s.v, k.y, s.center)), s.n, Real(1) / area_of_disc(s));
  Mask near = disc_may_be_near(s, from);
  if (none(near)) return r;
  const SphericalRectangle q = square_around(s, from);
  near = near && q.solid_angle > Real(kMinSolidAngle);
  const Vec w = sample_spherical_rectangle(q, u);
  const Vec p = w + (from - s.center);
  const Real a = dot(p, s.dual_u), b = dot(p, s.dual_v);
  const Real d = length(w);
  r.d = select(near, w * (Real(1) / d), r.d);
  r.distance = select(near, d, r.distance);
  r.pdf = select(near, Real(1) / q.solid_angle, r.pdf);
  r.valid = select(near, a * a + b * b <= Real(1), r.valid);
  return r;
}

inline Real pdf_disc(const Disc& s, Vec from, Vec d, Real t) {
  const Real by_area = solid_angle_pdf(Real(1) / area_of_disc(s), t * t, abs(dot(s.n, d)));
  const Mask near = disc_may_be_near(s, from);
  if (none(near)) return by_area;
  const Real solid_angle = square_around(s, from).solid_angle;
  return select(near && solid_angle > Real(kMinSolidAngle), Real(1) / solid_angle, by_area);
}

LIGHTBENCH_KERNEL_END
