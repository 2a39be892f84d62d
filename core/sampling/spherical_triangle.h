#pragma once
// Uniform sampling of the solid angle of a triangle (Arvo 1995, in the form of PBR 4th ed. A.5.4),
// with the solid angle from edges (van Oosterom & Strackee 1983), which stays precise at any
// distance.

#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// a, b, c relative to the reference point; e1 = b - a and e2 = c - a from the original vertices.
inline Real triangle_solid_angle(Vec a, Vec b, Vec c, Vec e1, Vec e2) {
  const Real la = length(a), lb = length(b), lc = length(c);
  const Real numerator = abs(dot(a, cross(e1, e2)));
  const Real denominator = fma(dot(b, c), la, fma(dot(a, c), lb, fma(dot(a, b), lc, la * lb * lc)));
  return T(2) * atan2(numerator, denominator);
}

/// Unit direction; pdf 1 / solid_angle. The vertices need not be unit.
inline Vec sample_spherical_triangle(Vec a, Vec b, Vec c, Real solid_angle, Vec2 u) {
  a = normalize(a);
  b = normalize(b);
  c = normalize(c);
  const Vec nab = normalize(cross(a, b)), nca = normalize(cross(c, a));
  const Real cos_alpha = clamp(-dot(nab, nca), Real(-1), Real(1));
  const Real sin_alpha = safe_sqrt(Real(1) - cos_alpha * cos_alpha);
  // The area cut off by the arc from b through c', plus pi.
  Real s, k;
  sincos(fma(u.x, solid_angle, kPi), s, k);
  const Real sin_phi = s * cos_alpha - k * sin_alpha;
  const Real cos_phi = k * cos_alpha + s * sin_alpha;
  const Real k1 = cos_phi + cos_alpha;
  const Real k2 = sin_phi - sin_alpha * dot(a, b);
  const Real numerator = k2 + (k2 * cos_phi - k1 * sin_phi) * cos_alpha;
  const Real denominator = (k2 * sin_phi + k1 * cos_phi) * sin_alpha;
  const Real cos_b =
      clamp(numerator / select(denominator == Real(0), Real(1), denominator), Real(-1), Real(1));
  const Real sin_b = safe_sqrt(Real(1) - cos_b * cos_b);
  const Vec toward_c = normalize(madd(a, -dot(c, a), c));
  const Vec cp = a * cos_b + toward_c * sin_b;
  const Real one_minus_cosine = u.y * (Real(1) - dot(cp, b));
  const Real cosine = Real(1) - one_minus_cosine;
  const Real sine = safe_sqrt(one_minus_cosine * (T(2) - one_minus_cosine));
  const Vec g = madd(b, -dot(cp, b), cp);
  const Real gg = length_squared(g);
  return b * cosine + g * (sine / sqrt(select(gg == Real(0), Real(1), gg)));
}

LIGHTBENCH_KERNEL_END
