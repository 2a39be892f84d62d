#pragma once
// Sphere, also moving linearly over the shutter, and its affine image (Ellipsoid).

#include "core/sampling/spherical_ellipse.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// `pole` (object +y) and `meridian` (object +x) orient its uv.
struct Sphere {
  static constexpr unsigned kRow = 13;
  Vec center;
  Real radius;
  Vec pole, meridian;
};

/// At each ray's time; if nothing is `moving` its motion, which is 0, is not read.
inline Sphere sphere_at(const auto& row, Real time, bool moving = true) {
  Vec center = row.vec(0);
  if (moving) center = madd(row.vec(4), time, center);
  return {center, row[3], row.vec(7), row.vec(10)};
}

/// The discriminant comes from the closest approach, so that far and small spheres keep their
/// outline (Haines et al., RTG ch. 7).
struct SphereHit {
  Interval span;
  Vec closest;  ///< relative to the centre
  Real half;    ///< half the length of the chord, as a ray parameter
};

/// `inverse_dd` = 1 / d.d
inline SphereHit hit_sphere(Vec o, Vec center, Vec d, Real inverse_dd, Real radius,
                            HitQuality quality) {
  const ClosestApproach a = closest_approach(o, center, d, inverse_dd, quality);
  const Real discriminant = radius * radius - length_squared(a.p);
  const Real h = safe_sqrt(discriminant * inverse_dd);
  return {{a.t - h, a.t + h, discriminant > Real(0)}, a.p, h};
}

/// Unit normal at the hit at parameter t.
inline Vec normal_at(const SphereHit& hit, Vec d, Real t) {
  return normalize(madd(d, select(at_exit(hit.span, t), hit.half, -hit.half), hit.closest));
}

inline SphereHit hit_sphere(const Sphere& s, const Ray& ray, HitQuality quality) {
  return hit_sphere(ray.o, s.center, ray.d, Real(1), s.radius, quality);
}

/// uv of the books: u around the pole from -x, v = 0 at the south pole; n in object space.
inline void sphere_uv(Vec n, Surface& s) {
  s.u = (atan2(-n.z, n.x) + kPi) * (kInvPi * T(0.5));
  s.v = acos(-n.y) * kInvPi;
}

/// Direction of growing u at object normal n; any tangent at the poles.
inline Vec sphere_tangent(Vec n) {
  const Real r = sqrt(n.x * n.x + n.z * n.z);
  const Mask pole = r == Real(0);
  const Real inverse = Real(1) / select(pole, Real(1), r);
  return {select(pole, Real(1), n.z * inverse), Real(0), select(pole, Real(0), -n.x * inverse)};
}

inline Surface surface_sphere(const Sphere& s, const Ray& ray, Real t, HitQuality quality,
                              Coordinates uv) {
  Surface r;
  r.ng = normal_at(hit_sphere(s, ray, quality), ray.d, t);
  r.ns = r.ng;
  r.p = madd(r.ng, s.radius, s.center);
  if (uv == Coordinates::None) return r;
  const Vec z = cross(s.meridian, s.pole);
  const Vec n{dot(r.ng, s.meridian), dot(r.ng, s.pole), dot(r.ng, z)};
  sphere_uv(n, r);
  const Vec q = sphere_tangent(n);
  r.tangent = madd(s.meridian, q.x, madd(s.pole, q.y, z * q.z));
  return r;
}

/// True where the sphere can be sampled by the cone it fills; sample and pdf share this.
inline Mask outside_sphere(const Sphere& s, Vec from, Real& d2) {
  d2 = length_squared(s.center - from);
  return d2 > s.radius * s.radius * T(1.0001);
}

/// 1 - cos of the cone's half angle without cancellation: sin^2 / (1 + cos).
inline Real cone_of_sphere(const Sphere& s, Real d2) {
  const Real sine2 = min(s.radius * s.radius / d2, Real(1));
  return sine2 / (Real(1) + sqrt(Real(1) - sine2));
}

inline LightSample sample_sphere(const Sphere& s, Vec from, Vec2 u) {
  Real d2;
  const Mask outside = outside_sphere(s, from, d2);
  const Real d = sqrt(d2);
  const Real cone = cone_of_sphere(s, d2);
  LightSample r;
  const Frame axis((s.center - from) * (Real(1) / select(outside, d, Real(1))));
  r.d = axis.to_world(square_to_cone(u, cone));
  // Distance to the near root, from the closest approach.
  const Vec f = from - s.center;
  const Real b = -dot(f, r.d);
  const Vec l = madd(r.d, b, f);
  r.distance = b - safe_sqrt(s.radius * s.radius - length_squared(l));
  r.n = normalize(madd(r.d, r.distance, f));
  r.pdf = pdf_cone(cone);
  r.valid = outside && r.distance > Real(0);
  if (any(!outside)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const SphereHit hit = hit_sphere(s, ray, HitQuality::Refined);
    const Vec n = normal_at(hit, ray.d, first_end(hit.span));
    r = select(outside, r, toward_solid(ray.d, hit.span, n, Real(kPdfSphere)));
  }
  return r;
}

inline Real pdf_sphere(const Sphere& s, Vec from) {
  Real d2;
  const Mask outside = outside_sphere(s, from, d2);
  return select(outside, pdf_cone(cone_of_sphere(s, d2)), Real(kPdfSphere));
}

// ---- ellipsoid
// -------------------------------------------------------------------------------------

/// The unit sphere mapped by `to_world`; the ray is traced in the unit sphere's space, t unchanged.
struct Ellipsoid {
  static constexpr unsigned kRow = 39;
  Affine to_local, to_world;
  Vec shift;  ///< motion so far
};

inline Ellipsoid ellipsoid_at(const auto& row, Real time) {
  return {affine_at(row, 0), affine_at(row, 12), row.vec(24) * time};
}

inline SphereHit hit_ellipsoid(const Ellipsoid& e, const Ray& ray) {
  const Vec d = e.to_local.vector(ray.d);
  return hit_sphere(e.to_local.point(ray.o - e.shift), Vec(Real(0)), d, Real(1) / length_squared(d),
                    Real(1), HitQuality::Refined);
}

inline Surface surface_ellipsoid(const Ellipsoid& e, const Ray& ray, Real t, Coordinates uv) {
  Surface r;
  const Vec n = normal_at(hit_ellipsoid(e, ray), e.to_local.vector(ray.d), t);
  r.p = e.to_world.point(n) + e.shift;
  r.ng = normalize(e.to_local.transposed(n));
  r.ns = r.ng;
  if (uv == Coordinates::None) return r;
  sphere_uv(n, r);
  r.tangent = normalize(e.to_world.vector(sphere_tangent(n)));
  return r;
}

/// For light sampling only; its row comes after the ellipsoid's own numbers.
inline PrincipalAxes axes_of_ellipsoid(const auto& row) {
  return {row.vec(27), row.vec(30), row.vec(33), row.vec(36)};
}

/// The cone that the ellipsoid fills for a point outside of it; sample and pdf share this.
struct EllipsoidView {
  SphericalEllipse cone;
  Vec local;  ///< the point, in the unit sphere's space
  Real gap;   ///< the square of its distance from the centre there, less 1
  Mask outside;
};

inline EllipsoidView view_ellipsoid(const Ellipsoid& e, const PrincipalAxes& axes, Vec from) {
  EllipsoidView v;
  v.local = e.to_local.point(from - e.shift);
  const Real distance = length(v.local);
  v.gap = (distance - Real(1)) * (distance + Real(1));
  v.outside = v.gap > Real(T(1e-4));
  if (any(v.outside)) {
    const Vec f = e.to_world.vector(v.local), s = axes.squares;
    v.cone = spherical_ellipse_of_ellipsoid(axes, {dot(f, axes.a), dot(f, axes.b), dot(f, axes.c)},
                                            s.x * s.y * s.z * v.gap);
  }
  return v;
}

/// Nearly uniform over the solid angle; all around from inside.
inline LightSample sample_ellipsoid(const Ellipsoid& e, const PrincipalAxes& axes, Vec from,
                                    Vec2 u) {
  const EllipsoidView v = view_ellipsoid(e, axes, from);
  LightSample r{Vec(Real(0)), Vec(Real(0)), Real(0), Real(0), Mask(false)};
  if (any(v.outside)) {
    const EllipseSample s = sample_spherical_ellipse(v.cone, square_to_disk(u));
    r.d = s.d;
    r.pdf = s.pdf;
    // The near root, from the closest approach in the unit sphere's space.
    const Vec d = e.to_local.vector(r.d);
    const Real inverse_dd = Real(1) / length_squared(d);
    const ClosestApproach a =
        closest_approach(v.local, Vec(Real(0)), d, inverse_dd, HitQuality::Refined);
    const Real discriminant = Real(1) - length_squared(a.p);
    const Real half = safe_sqrt(discriminant * inverse_dd);
    r.distance = v.gap * inverse_dd / (a.t + half);
    r.n = normalize(e.to_local.transposed(madd(d, r.distance, v.local)));
    r.valid =
        v.outside && discriminant >= Real(0) && r.distance > Real(0) && r.pdf < Real(kInfinity);
  }
  if (any(!v.outside)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const Interval span = hit_ellipsoid(e, ray).span;
    const Vec n = surface_ellipsoid(e, ray, first_end(span), Coordinates::None).ng;
    r = select(v.outside, r, toward_solid(ray.d, span, n, Real(kPdfSphere)));
  }
  return r;
}

inline Real pdf_ellipsoid(const Ellipsoid& e, const PrincipalAxes& axes, Vec from, Vec d) {
  const EllipsoidView v = view_ellipsoid(e, axes, from);
  if (none(v.outside)) return Real(kPdfSphere);
  return select(v.outside, pdf_spherical_ellipse(v.cone, d), Real(kPdfSphere));
}

LIGHTBENCH_KERNEL_END
