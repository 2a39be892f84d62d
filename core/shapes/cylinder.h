#pragma once
// Capped cylinder of any direction, and its affine image (EllipticCylinder).

#include "core/sampling/cylinder_side.h"
#include "core/sampling/spherical_ellipse.h"
#include "core/shapes/shape.h"
#include "core/shapes/sphere.h"

LIGHTBENCH_KERNEL_BEGIN

/// Axis and meridian are unit and perpendicular; `half` is half the height.
struct Cylinder {
  static constexpr unsigned kRow = 11;
  Vec middle, axis, meridian;
  Real half, radius;
};

inline Cylinder cylinder_at(const auto& row) {
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

/// What a point sees of a cylinder: the side from beside it, a cap from beyond that; of its inside
/// everything. Side and cap are chosen by their solid angles, about.
struct CylinderView {
  CylinderSide side;
  SphericalEllipse cap;
  Vec cap_from;  ///< the point relative to the centre of the cap
  Mask beside, beyond;
  Real cap_share;  ///< probability of the cap
};

/// Sets the probabilities when the rest is known.
inline void choose_parts(CylinderView& v) {
  const Real side = any(v.beside) ? select(v.beside, v.side.solid_angle, Real(0)) : Real(0);
  const Real cap = any(v.beyond) ? select(v.beyond, solid_angle_about(v.cap), Real(0)) : Real(0);
  v.cap_share = cap / select(side + cap > Real(0), side + cap, Real(1));
}

/// Density of direction d where it meets the cap (on_cap) or the side; x and y are its coordinates
/// in the side's frame.
inline Real pdf_cylinder_parts(const CylinderView& v, Vec d, Real x, Real y, Mask on_cap) {
  Real pdf(kPdfSphere);
  if (any(v.beside)) {
    const Real side = pdf_cylinder_side(v.side, x, y) * (Real(1) - v.cap_share);
    pdf = select(v.beside, side, pdf);
  }
  if (any(v.beyond)) {
    const Real cap = pdf_spherical_ellipse(v.cap, d) * v.cap_share;
    pdf = select(v.beyond && (on_cap || !v.beside), cap, pdf);
  }
  return pdf;
}

/// Random numbers for the part that is chosen.
struct PartChoice {
  Mask cap;
  Vec2 u;
};
inline PartChoice choose_part(const CylinderView& v, Vec2 u) {
  const Mask cap = v.beyond && (u.x < v.cap_share || !v.beside);
  const Real share = select(cap, v.cap_share, Real(1) - v.cap_share);
  const Real x = select(cap, u.x, u.x - v.cap_share) / select(share > Real(0), share, Real(1));
  return {cap, {clamp(x, Real(0), Real(1 - kEpsilon)), u.y}};
}

inline CylinderView view_cylinder(const Cylinder& c, Vec from) {
  CylinderView v;
  const Vec f = from - c.middle;
  const Real height = dot(f, c.axis);
  const Vec off = madd(c.axis, -height, f);
  const Real rho = length(off);
  const Real margin = Real(kSurfaceMargin) * (c.radius + c.half);
  const Mask outside = max(rho - c.radius, abs(height) - c.half) > margin;
  v.beside = outside && rho > c.radius;
  v.beyond = outside && abs(height) > c.half;
  if (any(v.beside)) {
    CylinderSide& s = v.side;
    const Real inverse = Real(1) / c.radius;
    s.axis = c.axis;
    s.x = off * (-c.radius / rho);
    s.y = cross(c.axis, s.x);
    s.lean_x = Real(0);
    s.lean_y = Real(0);
    s.rho = rho * inverse;
    s.gap = (rho - c.radius) * (rho + c.radius) * (inverse * inverse);
    s.top = c.half - height;
    s.bottom = -c.half - height;
    s.height = T(2) * c.half;
    s.turn = c.radius * c.radius;
    prepare_cylinder_side(s);
  }
  if (any(v.beyond)) {
    const Vec n = c.axis * copysign(Real(1), height);
    v.cap_from = madd(n, -c.half, f);
    v.cap = spherical_ellipse_of_circle(v.cap_from, abs(height) - c.half, n, c.radius);
  }
  choose_parts(v);
  return v;
}

inline Real pdf_cylinder(const CylinderView& v, const Cylinder& c, Vec d, Vec n) {
  const Mask on_cap = abs(dot(n, c.axis)) > Real(T(0.5));
  // The side is set only where it is seen.
  const bool beside = any(v.beside);
  const Real x = beside ? dot(d, v.side.x) : Real(0), y = beside ? dot(d, v.side.y) : Real(0);
  return pdf_cylinder_parts(v, d, x, y, on_cap);
}

/// n is the outward normal where d meets the cylinder.
inline Real pdf_cylinder(const Cylinder& c, Vec from, Vec d, Vec n) {
  return pdf_cylinder(view_cylinder(c, from), c, d, n);
}

/// Nearly uniform over the solid angle; all around from inside.
inline LightSample sample_cylinder(const Cylinder& c, Vec from, Vec2 u) {
  const CylinderView v = view_cylinder(c, from);
  const PartChoice part = choose_part(v, u);
  LightSample r{Vec(Real(0)), Vec(Real(0)), Real(0), Real(0), Mask(false)};
  if (any(v.beside && !part.cap)) {
    const SideSample s = sample_cylinder_side(v.side, part.u);
    const Vec n = (v.side.x * s.normal_x + v.side.y * s.normal_y) * (Real(1) / c.radius);
    r = {s.d, n, s.distance, Real(0), s.distance > Real(0) && s.distance < Real(kInfinity)};
  }
  if (any(part.cap)) {
    const Vec n = c.axis * copysign(Real(1), dot(from - c.middle, c.axis));
    const Vec d = sample_spherical_ellipse(v.cap, square_to_disk(part.u)).d;
    r = select(part.cap, toward_plane(d, -v.cap_from, n, Real(0)), r);
  }
  // Of the direction as it is rounded, which is what a ray along it computes.
  r.pdf = pdf_cylinder(v, c, r.d, r.n);
  r.valid = r.valid && r.pdf > Real(0) && r.pdf < Real(kInfinity);
  const Mask within = !v.beside && !v.beyond;
  if (any(within)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const Interval span = hit_cylinder(c, ray, HitQuality::Refined);
    const Vec n =
        surface_cylinder(c, ray, first_end(span), HitQuality::Refined, Coordinates::None).ng;
    r = select(within, toward_solid(ray.d, span, n, Real(kPdfSphere)), r);
  }
  return r;
}

// ---- elliptic cylinder
// -----------------------------------------------------------------------------

/// The cylinder of radius 1 and half height 1 around +y, mapped by `to_world`.
struct EllipticCylinder {
  static constexpr unsigned kRow = 25;
  Affine to_local, to_world;
  Real determinant;
};

inline EllipticCylinder elliptic_cylinder_at(const auto& row) {
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

/// The view of the image of the canonical cylinder, and its frame in that one's space.
struct EllipticCylinderView {
  CylinderView parts;
  Vec local;  ///< the point
  Vec local_x, local_y;
};

inline EllipticCylinderView view_elliptic_cylinder(const EllipticCylinder& e, Vec from) {
  EllipticCylinderView r;
  CylinderView& v = r.parts;
  r.local = e.to_local.point(from);
  const Vec off{r.local.x, Real(0), r.local.z};
  const Real rho = length(off);
  const Mask outside = max(rho, abs(r.local.y)) - Real(1) > Real(kSurfaceMargin);
  v.beside = outside && rho > Real(1);
  v.beyond = outside && abs(r.local.y) > Real(1);
  r.local_x = off * (Real(-1) / rho);
  r.local_y = {r.local_x.z, Real(0), -r.local_x.x};
  if (any(v.beside)) {
    CylinderSide& s = v.side;
    const Vec up = e.to_world.vector({Real(0), Real(1), Real(0)});
    const Real half = length(up);
    s.axis = up * (Real(1) / half);
    const Vec x = e.to_world.vector(r.local_x), y = e.to_world.vector(r.local_y);
    s.lean_x = dot(x, s.axis);
    s.lean_y = dot(y, s.axis);
    s.x = madd(s.axis, -s.lean_x, x);
    s.y = madd(s.axis, -s.lean_y, y);
    s.rho = rho;
    s.gap = (rho - Real(1)) * (rho + Real(1));
    // Not by way of the local point: of a skewed cylinder seen from afar its roundings would cost
    // several digits.
    const Real middle = dot(e.to_world.point(Vec(Real(0))) - from, s.axis);
    s.top = middle + half;
    s.bottom = middle - half;
    s.height = T(2) * half;
    s.turn = e.determinant / half;
    prepare_cylinder_side(s);
  }
  if (any(v.beyond)) {
    const Real side = copysign(Real(1), r.local.y);
    const PrincipalAxes axes = axes_of_ellipse(e.to_world.vector({Real(1), Real(0), Real(0)}),
                                               e.to_world.vector({Real(0), Real(0), Real(1)}));
    v.cap_from = from - e.to_world.point({Real(0), side, Real(0)});
    const Real height =
        (abs(r.local.y) - Real(1)) / length(e.to_local.transposed({Real(0), Real(1), Real(0)}));
    v.cap = spherical_ellipse_of_ellipsoid(axes,
                                           {dot(v.cap_from, axes.a), dot(v.cap_from, axes.b),
                                            copysign(height, dot(v.cap_from, axes.c))},
                                           axes.squares.x * axes.squares.y * height * height);
  }
  choose_parts(v);
  return r;
}

inline Real pdf_elliptic_cylinder(const EllipticCylinderView& v, const EllipticCylinder& e, Vec d,
                                  Vec n) {
  const Vec local = e.to_local.vector(d), normal = e.to_world.transposed(n);
  const Mask on_cap = abs(normal.y) > abs(normal.x) + abs(normal.z);
  return pdf_cylinder_parts(v.parts, d, dot(local, v.local_x), dot(local, v.local_y), on_cap);
}

/// n is the outward normal where d meets the cylinder.
inline Real pdf_elliptic_cylinder(const EllipticCylinder& e, Vec from, Vec d, Vec n) {
  return pdf_elliptic_cylinder(view_elliptic_cylinder(e, from), e, d, n);
}

/// As sample_cylinder().
inline LightSample sample_elliptic_cylinder(const EllipticCylinder& e, Vec from, Vec2 u) {
  const EllipticCylinderView v = view_elliptic_cylinder(e, from);
  const PartChoice part = choose_part(v.parts, u);
  LightSample r{Vec(Real(0)), Vec(Real(0)), Real(0), Real(0), Mask(false)};
  if (any(v.parts.beside && !part.cap)) {
    const SideSample s = sample_cylinder_side(v.parts.side, part.u);
    const Vec n = e.to_local.transposed(v.local_x * s.normal_x + v.local_y * s.normal_y);
    r = {s.d, normalize(n), s.distance, Real(0),
         s.distance > Real(0) && s.distance < Real(kInfinity)};
  }
  if (any(part.cap)) {
    const Vec n = e.to_local.transposed({Real(0), copysign(Real(1), v.local.y), Real(0)});
    const Vec d = sample_spherical_ellipse(v.parts.cap, square_to_disk(part.u)).d;
    r = select(part.cap, toward_plane(d, -v.parts.cap_from, normalize(n), Real(0)), r);
  }
  r.pdf = pdf_elliptic_cylinder(v, e, r.d, r.n);
  r.valid = r.valid && r.pdf > Real(0) && r.pdf < Real(kInfinity);
  const Mask within = !v.parts.beside && !v.parts.beyond;
  if (any(within)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const Interval span = hit_elliptic_cylinder(e, ray);
    const Vec n = surface_elliptic_cylinder(e, ray, first_end(span), Coordinates::None).ng;
    r = select(within, toward_solid(ray.d, span, n, Real(kPdfSphere)), r);
  }
  return r;
}

LIGHTBENCH_KERNEL_END
