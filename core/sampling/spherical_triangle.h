#pragma once
// Uniform sampling of the solid angle of a triangle, at any distance and up to the full half space.
// The solid angle comes from edges (van Oosterom & Strackee 1983), which keeps it precise from
// afar.
//
// The map is Arvo's (1995) in half-angle form. A fan of great circles turns around the vertex p,
// from q towards r; S is half the solid angle that it has swept. With the arc c = pq and the angle
// A at q, the fan has turned by B and its rim is the arc a from p, where
//
//   cot(B - S) = (tan^2(c/2) sin(A - S) - sin S cos A) / (sin S sin A)
//   tan(a/2)   = sin S / (tan(c/2) sin(B - S))
//
// (L'Huilier's half-side formulas, solved for B). Nothing here cancels: not for small triangles,
// where S is the square of c, nor for the full half space, where A, B and S approach pi together.

#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// b x c and what rounding took from it.
struct ExactCross {
  Vec value, lost;
};
inline ExactCross exact_cross(Vec b, Vec c) {
  const auto component = [](Real w, Real x, Real y, Real z, Real& value, Real& lost) {
    const Real wx = w * x, yz = y * z;
    value = wx - yz;
    lost = difference_error(wx, yz, value) + (fma(w, x, -wx) - fma(y, z, -yz));
  };
  ExactCross n;
  component(b.y, c.z, b.z, c.y, n.value.x, n.lost.x);
  component(b.z, c.x, b.x, c.z, n.value.y, n.lost.y);
  component(b.x, c.y, b.y, c.x, n.value.z, n.lost.z);
  return n;
}

/// a . b as a sum, and what rounding took from it. `a_lost` and `b_lost` are what it took from the
/// two.
struct ExactDot {
  Real value, lost;
};
inline ExactDot exact_dot(Vec a, Vec a_lost, Vec b, Vec b_lost) {
  const Vec p = a * b;
  const Vec lost{fma(a.x, b.x, -p.x), fma(a.y, b.y, -p.y), fma(a.z, b.z, -p.z)};
  const Real first = p.x + p.y, sum = first + p.z;
  return {sum, difference_error(p.x, -p.y, first) + difference_error(first, -p.z, sum) +
                   (lost.x + lost.y + lost.z) + dot(a_lost, b) + dot(a, b_lost)};
}

/// a . b x c without the cancellation that a light seen at a grazing angle would suffer in float:
/// rounding errors are put back. `a_lost`, `b_lost` and `c_lost` are what rounding took from the
/// three.
inline Real triple_product(Vec a, Vec a_lost, Vec b, Vec b_lost, Vec c, Vec c_lost) {
  const ExactCross n = exact_cross(b, c);
  const ExactDot r = exact_dot(a, a_lost, n.value, n.lost + cross(b_lost, c) + cross(b, c_lost));
  return r.value + r.lost;
}
inline Real triple_product(Vec a, Vec a_lost, Vec b, Vec c) {
  return triple_product(a, a_lost, b, Vec(Real(0)), c, Vec(Real(0)));
}

/// |a| |b| |c| (1 + the cosines of the sides): what the tangent of half the solid angle divides the
/// determinant by.
inline Real solid_angle_divisor(Vec a, Vec b, Vec c, Real la, Real lb, Real lc) {
  return fma(dot(b, c), la, fma(dot(a, c), lb, fma(dot(a, b), lc, la * lb * lc)));
}

/// The same without the cancellation that it suffers within a solid angle's width of an edge, where
/// two sides nearly add up to pi; with what rounding took from the three. Never inlined: few lanes
/// need it.
[[gnu::noinline]] inline Real exact_solid_angle_divisor(Vec a, Vec a_lost, Vec b, Vec b_lost, Vec c,
                                                        Vec c_lost) {
  const auto length_of = [](Vec v, Vec lost) -> ExactDot {
    const ExactDot squared = exact_dot(v, lost, v, lost);
    const Real l = sqrt(squared.value);
    return {l, (fma(-l, l, squared.value) + squared.lost) * (T(0.5) / l)};
  };
  const auto times = [](ExactDot x, ExactDot y) -> ExactDot {
    const Real p = x.value * y.value;
    return {p, fma(x.value, y.value, -p) + (x.lost * y.value + x.value * y.lost)};
  };
  const auto plus = [](ExactDot x, ExactDot y) -> ExactDot {
    const Real sum = x.value + y.value;
    return {sum, difference_error(x.value, -y.value, sum) + (x.lost + y.lost)};
  };
  const ExactDot la = length_of(a, a_lost), lb = length_of(b, b_lost), lc = length_of(c, c_lost);
  const ExactDot r = plus(
      plus(times(times(la, lb), lc), times(exact_dot(b, b_lost, c, c_lost), la)),
      plus(times(exact_dot(a, a_lost, c, c_lost), lb), times(exact_dot(a, a_lost, b, b_lost), lc)));
  return r.value + r.lost;
}

/// Half the solid angle (0 to pi) of the triangle a, b, c relative to the viewpoint; la, lb, lc are
/// their lengths and `determinant` is |a . (b - a) x (c - a)|, from the original edges.
inline Real half_solid_angle(Vec a, Vec b, Vec c, Real la, Real lb, Real lc, Real determinant) {
  return atan2(determinant, solid_angle_divisor(a, b, c, la, lb, lc));
}

/// Unit direction. p and q are relative to the viewpoint; the edges pq and pr to q and r are those
/// of the original triangle. `swept` is half the solid angle behind the fan, from 0 to that of the
/// whole triangle; v in [0,1) goes along it, from p outward. Meaningless if the triangle is seen
/// edge on.
inline Vec sample_spherical_fan(Vec p, Vec q, Vec pq, Vec pr, Real swept, Real v) {
  const Real length_p = length(p);
  const Vec to_p = p * (Real(1) / length_p), to_q = normalize(q);
  const Vec side = cross(to_q, pq);  // along p x q
  const Real side2 = length_squared(side);
  const Real determinant = triple_product(to_q, Vec(Real(0)), pq, pr);
  const Real y = abs(determinant), x = -dot(side, cross(to_q, pr - pq));
  const Real inverse = Real(1) / sqrt(fma(y, y, x * x));
  const Real sin_a = y * inverse, cos_a = x * inverse;
  // tan^2 of half the arc pq, in the form that does not cancel.
  const Real along = dot(p, to_q);
  const Real sum2 = square(length_p + abs(along));
  const Real tan2 = select(along > Real(0), side2 / sum2, sum2 / side2);

  Real sin_s, cos_s;
  sincos(swept, sin_s, cos_s);
  const Real share = sin_s / tan2;
  const Real xb = fma(sin_a, cos_s, -(cos_a * sin_s)) - share * cos_a;  // of B - S
  const Real yb = share * sin_a;
  const Real h2 = fma(xb, xb, yb * yb);
  const Real inverse_h = Real(1) / sqrt(h2);
  const Real cos_b = (xb * cos_s - yb * sin_s) * inverse_h;
  const Real sin_b = (yb * cos_s + xb * sin_s) * inverse_h;
  // 1 - cos of the rim's arc is twice the square of the sine of its half.
  const Real rim = tan2 * h2;
  const Real drop = T(2) * v * (rim / fma(sin_a, sin_a, rim));
  const Real sine = safe_sqrt(drop * (T(2) - drop));
  const Vec across = side * (Real(1) / sqrt(side2));
  const Vec out = madd(cross(across, to_p), cos_b, across * copysign(sin_b, determinant));
  return normalize(madd(to_p, Real(1) - drop, out * sine));
}

LIGHTBENCH_KERNEL_END
