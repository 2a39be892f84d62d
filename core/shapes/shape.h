#pragma once
// What all shapes share. A solid gives the interval that a ray spends inside it; that one routine
// serves surfaces, media boundaries and shadow rays, so a rim or an edge can neither leak nor be
// hit twice. A ray remembers the primitive it left: a planar one is never hit again, a convex solid
// only at its exit and only by a ray that goes inside (no minimal distance anywhere).

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

struct Ray {
  Vec o, d;  ///< d is unit in render space; instances trace it unnormalised
  Real time;
  Int from;             ///< primitive it left, kNoHit for none
  Int from_slot;        ///< triangle slot of a mesh
  Mask inside;          ///< it left `from` towards the inside
  Int skip, skip_slot;  ///< shadow rays: the light they aim at, no occluder of itself...
  Mask skip_back;  ///< ... unless they aim at the inner side of a solid and have to enter it first
};

/// Parameters at which a ray enters and leaves a convex solid; meaningless where !hit.
struct Interval {
  Real near, far;
  Mask hit;
};

/// A planar shape's answer.
struct PlaneHit {
  Real t;
  Mask hit;
};

/// A point of a surface, recomputed on the surface. `ng` is unit and points outward (to the front);
/// `tangent` is the unit direction of increasing u. With Coordinates::None u, v and tangent may
/// stay unset: they cost arc functions and square roots, and only textures and queries ask for
/// them.
struct Surface {
  Vec p, ng, ns, tangent = Vec(Real(0));
  Real u = Real(0), v = Real(0);
};
enum class Coordinates { None, Wanted };

/// A direction towards a light. pdf in solid angle at the reference point, over visible directions;
/// `n` is the light's outward unit normal there. Where !valid nothing arrives.
struct LightSample {
  Vec d, n;
  Real distance, pdf;
  Mask valid;
};

/// The point of a ray closest to a centre: ray parameter, and position relative to the centre.
struct ClosestApproach {
  Real t;
  Vec p;
};

/// `inverse_dd` = 1 / d.d. Refined, the position is good to the last bits of its own length however
/// far away the ray starts: the rounding of o - center is put back, and a second step removes what
/// the rounding of the first parameter left along the ray; what it left across is of second order.
inline ClosestApproach closest_approach(Vec o, Vec center, Vec d, Real inverse_dd,
                                        HitQuality quality) {
  const Vec f = o - center;
  const Real t = -dot(f, d) * inverse_dd;
  if (quality == HitQuality::Plain) return {t, madd(d, t, f)};
  const Vec p = madd(d, t, f) + difference_error(o, center, f);
  const Real step = -dot(p, d) * inverse_dd;
  return {t + step, madd(d, step, p)};
}

/// A point nearer than this (in sizes of the shape) to the surface of a solid counts as inside for
/// light sampling, where all directions are alike: a point that leaves the inner side is only
/// further in by the rounding of its coordinates, and its distance to the face is rounded too.
inline constexpr T kSurfaceMargin = T(64) * kEpsilon;

/// True where t is the exit of the interval rather than its entry.
inline Mask at_exit(const Interval& i, Real t) { return abs(t - i.far) < abs(t - i.near); }

/// A ray to ask with, that left nothing and skips nothing.
inline Ray probe_ray(Vec o, Vec d, Real time = Real(0)) {
  return {o, d, time, Int(kNoHit), Int(kNoHit), Mask(false), Int(kNoHit), Int(kNoHit), Mask(false)};
}

inline LightSample select(Mask m, const LightSample& a, const LightSample& b) {
  return {select(m, a.d, b.d), select(m, a.n, b.n), select(m, a.distance, b.distance),
          select(m, a.pdf, b.pdf), select(m, a.valid, b.valid)};
}

/// pdf in solid angle of a point chosen with `pdf_area`, seen over `distance_squared` at `cosine`.
inline Real solid_angle_pdf(Real pdf_area, Real distance_squared, Real cosine) {
  return pdf_area * distance_squared / cosine;
}

/// Completes a sample from a point of the light with normal n, chosen with density `pdf_area`; w is
/// the point relative to the reference point.
inline LightSample toward_point(Vec w, Vec n, Real pdf_area) {
  LightSample s;
  const Real d2 = length_squared(w);
  s.distance = sqrt(d2);
  s.d = w * (Real(1) / s.distance);
  s.n = n;
  s.pdf = solid_angle_pdf(pdf_area, d2, abs(dot(n, s.d)));
  s.valid = d2 > Real(0) && s.pdf > Real(0) && s.pdf < Real(kInfinity);
  return s;
}

/// Completes a sample of a flat light from its unit direction d; `point` is any point of the plane
/// relative to the reference point, n its unit normal.
inline LightSample toward_plane(Vec d, Vec point, Vec n, Real pdf) {
  const Real t = dot(n, point) / dot(n, d);
  return {d, n, t, pdf, t > Real(0) && t < Real(kInfinity) && pdf < Real(kInfinity)};
}

/// Completes a sample of a solid light seen from within, where every direction is as likely
/// (kPdfSphere): d meets the solid over `span`, with outward normal n where it does so first. Also
/// right for points that only rounding puts inside.
inline Real first_end(const Interval& span) {
  return select(span.near > Real(0), span.near, span.far);
}
inline LightSample toward_solid(Vec d, const Interval& span, Vec n, Real pdf) {
  const Real t = first_end(span);
  return {d, n, t, pdf, span.hit && t > Real(0)};
}

LIGHTBENCH_KERNEL_END
