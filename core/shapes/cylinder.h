#pragma once
// Capped cylinder of any direction, and its affine image (EllipticCylinder).

#include "core/sampling/warp.h"
#include "core/shapes/shape.h"
#include "core/shapes/sphere.h"

LIGHTBENCH_KERNEL_BEGIN

/// Axis and meridian are unit and perpendicular; `half` is half the height.
struct Cylinder {
  static constexpr unsigned kRow = 11;
  Vec middle, axis, meridian;
  Real half, radius;
};

inline Cylinder cylinder_at(const Row& row) {
  return {row.vec(0), row.vec(3), row.vec(6), row[9], row[10]};
}

/// Which part of the surface an end of the interval lies on.
struct CylinderInterval {
  Interval span;
  Mask near_cap, far_cap;
};

/// Side and slab intervals clipped against each other: the winner of each max/min names the face,
/// so the rims can neither leak nor count twice. The origin is first moved to the closest approach.
inline CylinderInterval hit_cylinder(const Cylinder& c, Vec o, Vec d, Real inverse_dd,
                                     HitQuality quality) {
  const ClosestApproach near_middle = closest_approach(o, c.middle, d, inverse_dd, quality);
  const Vec f = near_middle.p;
  const Real shift = near_middle.t;
  const Real dz = dot(d, c.axis), fz = dot(f, c.axis);
  const Vec dp = madd(c.axis, -dz, d), fp = madd(c.axis, -fz, f);
  const Real a = length_squared(dp);
  const Mask parallel = a <= Real(0);
  const Real inverse_a = Real(1) / select(parallel, Real(1), a);
  const Real middle = -dot(fp, dp) * inverse_a;
  const Vec l = madd(dp, select(parallel, Real(0), middle), fp);
  const Real discriminant = c.radius * c.radius - length_squared(l);
  const Real h = safe_sqrt(discriminant * inverse_a);
  const Real side_near = select(parallel, Real(-kInfinity), middle - h);
  const Real side_far = select(parallel, Real(kInfinity), middle + h);
  const Mask level = dz == Real(0);
  const Real inverse_dz = Real(1) / select(level, Real(1), dz);
  const Real t0 = (-c.half - fz) * inverse_dz, t1 = (c.half - fz) * inverse_dz;
  const Real cap_near = select(level, Real(-kInfinity), min(t0, t1));
  const Real cap_far = select(level, Real(kInfinity), max(t0, t1));
  CylinderInterval r;
  r.near_cap = cap_near > side_near;
  r.far_cap = cap_far < side_far;
  const Real near = max(cap_near, side_near), far = min(cap_far, side_far);
  r.span.hit = discriminant > Real(0) && near < far && (!level || abs(fz) < c.half);
  r.span.near = near + shift;
  r.span.far = far + shift;
  return r;
}

inline Interval hit_cylinder(const Cylinder& c, const Ray& ray, HitQuality quality) {
  return hit_cylinder(c, ray.o, ray.d, Real(1), quality).span;
}

/// Surface in the cylinder's own frame, given the local point of the hit and whether it is on a
/// cap. uv: u around the axis; v along the side, or the radius share on a cap.
inline Surface surface_cylinder(const Cylinder& c, Vec o, Vec d, Real inverse_dd, Real t,
                                HitQuality quality, Coordinates uv) {
  const CylinderInterval i = hit_cylinder(c, o, d, inverse_dd, quality);
  const Mask exit = at_exit(i.span, t);
  const Mask cap = select(exit, i.far_cap, i.near_cap);
  const Vec q = madd(d, t, o - c.middle);
  const Real z = dot(q, c.axis);
  const Vec perp = madd(c.axis, -z, q);
  const Real rho = length(perp);
  const Vec radial = select(rho > Real(0), perp * (Real(1) / max(rho, Real(T(1e-30)))), c.meridian);
  const Real level = copysign(c.half, z);
  // A ray along the side can land beyond the rim by the rounding of t.
  const Real along = clamp(z, -c.half, c.half);
  Surface r;
  r.ng = select(cap, c.axis * copysign(Real(1), z), radial);
  r.ns = r.ng;
  r.p = c.middle +
        madd(c.axis, select(cap, level, along), radial * select(cap, min(rho, c.radius), c.radius));
  if (uv == Coordinates::None) return r;
  const Vec binormal = cross(c.axis, c.meridian);
  r.u = atan2(dot(radial, binormal), dot(radial, c.meridian)) * (kInvPi * T(0.5)) + Real(T(0.5));
  r.v = select(cap, min(rho / c.radius, Real(1)), (along / c.half + Real(1)) * T(0.5));
  r.tangent = cross(c.axis, radial);
  return r;
}

inline Surface surface_cylinder(const Cylinder& c, const Ray& ray, Real t, HitQuality quality,
                                Coordinates uv) {
  return surface_cylinder(c, ray.o, ray.d, Real(1), t, quality, uv);
}

/// A point uniform over side and caps with its normal, both relative to the cylinder's frame.
struct CylinderPoint {
  Vec p, n;
};
inline CylinderPoint point_of_cylinder(const Cylinder& c, Vec2 u) {
  // Shares of the area: each cap r / (2 (r + h)), the side h / (r + h), h the full height.
  const Real caps = c.radius / (c.radius + T(2) * c.half);
  const Mask on_cap = u.x < caps;
  const Vec binormal = cross(c.axis, c.meridian);
  const Real w = u.x / caps;
  const Mask top = w < Real(T(0.5));
  const Vec2 disk = square_to_disk({select(top, w * T(2), w * T(2) - T(1)), u.y});
  const Vec face = c.axis * select(top, Real(1), Real(-1));
  const Real z = ((u.x - caps) / (Real(1) - caps)) * T(2) - T(1);
  Real s, k;
  sincos(u.y * kTwoPi, s, k);
  const Vec radial = c.meridian * k + binormal * s;
  const Vec cap_point = face * c.half + (c.meridian * disk.x + binormal * disk.y) * c.radius;
  const Vec side_point = c.axis * (z * c.half) + radial * c.radius;
  return {c.middle + select(on_cap, cap_point, side_point), select(on_cap, face, radial)};
}

inline Real area_of_cylinder(const Cylinder& c) {
  return kTwoPi * c.radius * (c.radius + T(2) * c.half);
}

inline LightSample sample_cylinder(const Cylinder& c, Vec from, Vec2 u) {
  const CylinderPoint q = point_of_cylinder(c, u);
  return toward_point(from, q.p, q.n, Real(1) / area_of_cylinder(c));
}

inline Real pdf_cylinder(const Cylinder& c, Vec d, Real t, Vec n) {
  return solid_angle_pdf(Real(1) / area_of_cylinder(c), t * t, abs(dot(n, d)));
}

// ---- elliptic cylinder
// -----------------------------------------------------------------------------

/// The cylinder of radius 1 and half height 1 around +y, mapped by `to_world`.
struct EllipticCylinder {
  static constexpr unsigned kRow = 25;
  Affine to_local, to_world;
  Real determinant;
};

inline EllipticCylinder elliptic_cylinder_at(const Row& row) {
  return {affine_at(row, 0), affine_at(row, 12), row[24]};
}

inline Cylinder canonical_cylinder() {
  return {Vec(Real(0)), {Real(0), Real(1), Real(0)}, {Real(1), Real(0), Real(0)}, Real(1), Real(1)};
}

inline Interval hit_elliptic_cylinder(const EllipticCylinder& e, const Ray& ray) {
  const Vec d = e.to_local.vector(ray.d);
  return hit_cylinder(canonical_cylinder(), e.to_local.point(ray.o), d, Real(1) / length_squared(d),
                      HitQuality::Refined)
      .span;
}

inline Surface surface_elliptic_cylinder(const EllipticCylinder& e, const Ray& ray, Real t,
                                         Coordinates uv) {
  const Vec d = e.to_local.vector(ray.d);
  Surface r = surface_cylinder(canonical_cylinder(), e.to_local.point(ray.o), d,
                               Real(1) / length_squared(d), t, HitQuality::Refined, uv);
  r.p = e.to_world.point(r.p);
  r.ng = normalize(e.to_local.transposed(r.ng));
  r.ns = r.ng;
  if (uv == Coordinates::Wanted) r.tangent = normalize(e.to_world.vector(r.tangent));
  return r;
}

inline LightSample sample_elliptic_cylinder(const EllipticCylinder& e, Vec from, Vec2 u) {
  const Cylinder c = canonical_cylinder();
  const CylinderPoint q = point_of_cylinder(c, u);
  const Real pdf = stretched_pdf(Real(1) / area_of_cylinder(c), e.to_local, e.determinant, q.n);
  return toward_point(from, e.to_world.point(q.p), normalize(e.to_local.transposed(q.n)), pdf);
}

/// n is the unit normal in world space; back in local space it is M^T n, renormalised.
inline Real pdf_elliptic_cylinder(const EllipticCylinder& e, Vec d, Real t, Vec n) {
  const Vec local = normalize(e.to_world.transposed(n));
  const Real area_pdf = Real(1) / area_of_cylinder(canonical_cylinder());
  return solid_angle_pdf(stretched_pdf(area_pdf, e.to_local, e.determinant, local), t * t,
                         abs(dot(n, d)));
}

LIGHTBENCH_KERNEL_END
