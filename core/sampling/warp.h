#pragma once
// Warps of the unit square, each with its density below it.

#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

struct Vec2 {
  Real x, y;
};

/// Concentric map of the unit square to the unit disk (Shirley & Chiu 1997); area pdf 1/pi.
inline Vec2 square_to_disk(Vec2 u) {
  const Real a = u.x * T(2) - T(1), b = u.y * T(2) - T(1);
  const Mask wide = abs(a) > abs(b);
  const Real r = select(wide, a, b);
  const Real ratio = select(wide, b, a) / select(r == Real(0), Real(1), r);
  // The angle is this, or a quarter turn less this.
  Real s, c;
  sincos_octant(ratio * (kPi / 4), s, c);
  return {r * select(wide, c, s), r * select(wide, s, c)};
}

/// Cosine-weighted hemisphere around +z.
inline Vec square_to_cosine_hemisphere(Vec2 u) {
  const Vec2 d = square_to_disk(u);
  return {d.x, d.y, safe_sqrt(Real(1) - d.x * d.x - d.y * d.y)};
}
inline Real pdf_cosine_hemisphere(Real cosine) { return max(cosine, Real(0)) * kInvPi; }

/// Uniform unit sphere.
inline Vec square_to_sphere(Vec2 u) {
  const Real z = Real(1) - u.x * T(2);
  const Real r = safe_sqrt(T(2) * u.x * (Real(1) - u.x) * T(2));
  Real s, c;
  sincos(u.y * kTwoPi, s, c);
  return {r * c, r * s, z};
}
inline constexpr T kPdfSphere = T(0.25) * kInvPi;

/// Uniform directions of the cone around +z with 1 - cos(half angle) = `one_minus_cosine`, which is
/// passed instead of the cosine so that narrow cones keep their precision.
inline Vec square_to_cone(Vec2 u, Real one_minus_cosine) {
  const Real x = u.x * one_minus_cosine;  // 1 - cos(theta)
  const Real sine = safe_sqrt(x * (T(2) - x));
  Real s, c;
  sincos(u.y * kTwoPi, s, c);
  return {sine * c, sine * s, Real(1) - x};
}
inline Real pdf_cone(Real one_minus_cosine) { return kInvPi * T(0.5) / one_minus_cosine; }

/// Uniform barycentrics (b1, b2) of a triangle (Heitz 2019, low distortion).
inline Vec2 square_to_triangle(Vec2 u) {
  const Mask lower = u.x < u.y;
  const Real a = u.x * T(0.5), b = u.y * T(0.5);
  return {select(lower, a, u.x - b), select(lower, u.y - a, b)};
}

LIGHTBENCH_KERNEL_END
