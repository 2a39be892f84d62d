#pragma once
// Sphere, also moving linearly over the shutter, and its affine image (Ellipsoid).

#include "core/sampling/warp.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// `pole` (object +y) and `meridian` (object +x) orient its uv.
struct Sphere {
  static constexpr unsigned kRow = 13;
  Vec center;
  Real radius;
  Vec pole, meridian;
};

/// At each ray's time.
inline Sphere sphere_at(const Row& row, Real time) {
  return {madd(row.vec(4), time, row.vec(0)), row[3], row.vec(7), row.vec(10)};
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
    const Vec n = square_to_sphere(u);
    const Real area_pdf = Real(kPdfSphere) / (s.radius * s.radius);
    const LightSample inner = toward_point(from, madd(n, s.radius, s.center), n, area_pdf);
    r.d = select(outside, r.d, inner.d);
    r.n = select(outside, r.n, inner.n);
    r.distance = select(outside, r.distance, inner.distance);
    r.pdf = select(outside, r.pdf, inner.pdf);
    r.valid = select(outside, r.valid, inner.valid);
  }
  return r;
}

/// pdf of the direction d that meets the sphere at distance t with outward normal n.
inline Real pdf_sphere(const Sphere& s, Vec from, Vec d, Real t, Vec n) {
  Real d2;
  const Mask outside = outside_sphere(s, from, d2);
  const Real area_pdf = Real(kPdfSphere) / (s.radius * s.radius);
  return select(outside, pdf_cone(cone_of_sphere(s, d2)),
                solid_angle_pdf(area_pdf, t * t, abs(dot(n, d))));
}

// ---- ellipsoid
// -------------------------------------------------------------------------------------

/// The unit sphere mapped by `to_world`; the ray is traced in the unit sphere's space, t unchanged.
struct Ellipsoid {
  static constexpr unsigned kRow = 28;
  Affine to_local, to_world;
  Vec shift;         ///< motion so far
  Real determinant;  ///< |det| of to_world
};

inline Ellipsoid ellipsoid_at(const Row& row, Real time) {
  return {affine_at(row, 0), affine_at(row, 12), row.vec(24) * time, row[27]};
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

/// Area density at the image of the unit-area density `pdf` at a point whose normal is n in local
/// space: an affine map stretches area by |det M| |M^-T n|.
inline Real stretched_pdf(Real pdf, const Affine& to_local, Real determinant, Vec n) {
  return pdf / (determinant * length(to_local.transposed(n)));
}

inline LightSample sample_ellipsoid(const Ellipsoid& e, Vec from, Vec2 u) {
  const Vec n = square_to_sphere(u);
  const Real pdf = stretched_pdf(Real(kPdfSphere), e.to_local, e.determinant, n);
  return toward_point(from, e.to_world.point(n) + e.shift, normalize(e.to_local.transposed(n)),
                      pdf);
}

inline Real pdf_ellipsoid(const Ellipsoid& e, Vec from, Vec d, Real t, Vec n) {
  const Vec local = normalize(e.to_local.point(madd(d, t, from) - e.shift));
  const Real pdf = stretched_pdf(Real(kPdfSphere), e.to_local, e.determinant, local);
  return solid_angle_pdf(pdf, t * t, abs(dot(n, d)));
}

LIGHTBENCH_KERNEL_END
