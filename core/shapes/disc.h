#pragma once
// Disc with any centre, normal and radius; an ellipse when its object is scaled unevenly. Its two
// semi-axes are perpendicular (compile() sees to that).

#include "core/sampling/spherical_ellipse.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

struct Disc {
  static constexpr unsigned kRow = 18;
  Vec center, n, u, v;  ///< u x v points along n
  Vec dual_u, dual_v;   ///< dual_u . (p - center) is the first coordinate
};

inline Disc disc_at(const auto& row) {
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

/// True if the semi-axes are equal.
inline Mask is_circle(const Disc& s) {
  const Real uu = length_squared(s.u), vv = length_squared(s.v);
  return abs(uu - vv) <= T(4) * kEpsilon * (uu + vv);
}

/// Directions from a point that is f from the centre.
inline SphericalEllipse view_disc(const Disc& s, Vec f) {
  const Real height = dot(f, s.n);
  const Mask circle = is_circle(s);
  SphericalEllipse view = spherical_ellipse_of_circle(f, height, s.n, length(s.u));
  if (any(!circle)) {
    const PrincipalAxes axes = axes_of_ellipse(s.u, s.v);
    view =
        select(circle, view,
               spherical_ellipse_of_ellipsoid(axes, {dot(f, axes.a), dot(f, axes.b), height},
                                              axes.squares.x * axes.squares.y * height * height));
  }
  return view;
}

inline Real area_of_disc(const Disc& s) { return kPi * length(s.u) * length(s.v); }

/// Whether a disc is sampled by area, which costs less: where that leaves a relative variance below
/// .45, be it a receiver that faces the disc's middle or one parallel to the disc above a point of
/// it. Along the disc's plane that is beyond 2.55 of its (larger) radii, over its middle beyond
/// one; between them the square of that distance follows the sine of the angle to the normal.
inline Mask disc_is_far(const Disc& s, Vec f) {
  const Real d2 = length_squared(f), height = dot(f, s.n);
  const Real sine2 = Real(1) - height * height / d2;
  const Real limit = fma(sine2, fma(sine2, Real(T(2.5)), Real(3)), Real(1));
  return d2 > max(length_squared(s.u), length_squared(s.v)) * limit;
}

/// Nearly uniform over the solid angle, by a point k of the unit disk. Out of line, as its density
/// is: few points are so near.
[[gnu::noinline]] inline LightSample sample_near_disc(const Disc& s, Vec f, Vec2 k) {
  const EllipseSample e = sample_spherical_ellipse(view_disc(s, f), k);
  return toward_plane(e.d, -f, s.n, e.pdf);
}
[[gnu::noinline]] inline Real pdf_near_disc(const Disc& s, Vec f, Vec d) {
  return pdf_spherical_ellipse(view_disc(s, f), d);
}

/// Nearly uniform over the solid angle when near, else over the area; meaningful where `active`.
inline LightSample sample_disc(const Disc& s, Vec from, Vec2 u, Mask active = Mask(true)) {
  const Vec f = from - s.center;
  const Vec2 k = square_to_disk(u);
  LightSample r = toward_point(madd(s.u, k.x, s.v * k.y) - f, s.n, Real(1) / area_of_disc(s));
  const Mask near = active && !disc_is_far(s, f);
  if (any(near)) r = select(near, sample_near_disc(s, f, k), r);
  return r;
}

inline Real pdf_disc(const Disc& s, Vec from, Vec d, Real t, Mask active = Mask(true)) {
  const Vec f = from - s.center;
  Real pdf = solid_angle_pdf(Real(1) / area_of_disc(s), t * t, abs(dot(s.n, d)));
  const Mask near = active && !disc_is_far(s, f);
  if (any(near)) pdf = select(near, pdf_near_disc(s, f, d), pdf);
  return pdf;
}

LIGHTBENCH_KERNEL_END
