#pragma once
// Nearly uniform sampling of the solid angle of a cylinder's side, right or oblique, circular or
// elliptic, from a point outside of the cylinder without its caps.
//
// Azimuth psi around the axis, elevation e over the plane across it: d(omega) = d(psi) d(sin e). At
// each azimuth the point sees the near line of the side, between two elevations; sin(e) is uniform
// between them, exactly, and psi follows a piecewise linear density through the differences of the
// two sines at a few azimuths. So all samples are on the side and their density is known exactly.

#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// The side of a cylinder of unit radius in its own frame, seen from a point `rho` > 1 from its
/// axis. The frame's x points from there to the axis, y across; azimuths are those of the frame.
struct CylinderSide {
  static constexpr unsigned kHalf = 4, kNodes = 2 * kHalf + 1;
  Vec axis;             ///< unit, in the world as all vectors here
  Vec x, y;             ///< what x and y map to, less what they have along the axis ...
  Real lean_x, lean_y;  ///< ... and that
  Real rho, gap;        ///< gap = rho^2 - 1, without cancellation
  Real top, bottom;     ///< signed distances along the axis from the point to the caps' centres ...
  Real height;          ///< ... and their difference, which from afar would cancel
  Real turn;            ///< |x cross y|
  // The density of azimuths, by nodes.
  Real azimuth[kHalf + 1];  ///< from the middle one on; the others mirror them
  Real value[kNodes];
  Real solid_angle;  ///< about: the integral of the values
};

/// Azimuth of node i.
inline Real azimuth_of_node(const CylinderSide& s, unsigned i) {
  return i < CylinderSide::kHalf ? -s.azimuth[CylinderSide::kHalf - i]
                                 : s.azimuth[i - CylinderSide::kHalf];
}

/// The near line of the side at one azimuth.
struct SideLine {
  Vec toward;                  ///< unit, across the axis
  Real run;                    ///< distance across the axis
  Real low, high;              ///< its ends' signed heights over the point ...
  Real slant_low, slant_high;  ///< ... and their distances
  Real sines;                  ///< difference of the sines of their elevations
  Real weight;                 ///< solid angle per azimuth of the frame
};

/// `chord` is the cosine of the angle whose sine is rho sin(psi).
inline SideLine side_line(const CylinderSide& s, Real sine, Real cosine, Real chord) {
  SideLine r;
  const Real near = s.gap / fma(s.rho, cosine, chord);
  const Vec m = madd(s.x, cosine, s.y * sine);
  const Real across2 = length_squared(m), across = sqrt(across2);
  r.toward = m * (Real(1) / across);
  r.run = near * across;
  // From the axis to the near line, which is a unit vector however far the point is.
  const Real k = s.rho * sine;
  const Real off_x = -fma(chord, cosine, k * sine), off_y = fma(k, cosine, -(chord * sine));
  const Real lean = fma(s.lean_x, off_x, s.lean_y * off_y);
  r.low = lean + s.bottom;
  r.high = lean + s.top;
  const Real run2 = r.run * r.run;
  r.slant_low = sqrt(fma(r.low, r.low, run2));
  r.slant_high = sqrt(fma(r.high, r.high, run2));
  // sin a - sin b = (cos a + cos b) sin(a - b) / (1 + cos(a - b)) does not cancel if both have one
  // sign, the plain difference not if they have two.
  const Real product = r.low * r.high;
  const Real one_sign =
      run2 * s.height * (r.slant_low + r.slant_high) /
      (r.slant_low * r.slant_high * (fma(r.slant_low, r.slant_high, run2) + max(product, Real(0))));
  const Real two_signs = r.high / r.slant_high - r.low / r.slant_low;
  r.sines = select(product > Real(0), one_sign, two_signs);
  r.weight = r.sines * s.turn / across2;
  return r;
}

/// Fills the density's nodes from the rest.
inline void prepare_cylinder_side(CylinderSide& s) {
  // Nodes at chords that turn evenly, which crowds them where the near line moves fastest.
  constexpr T kSine[] = {T(0), T(0.38268343236508977), T(0.70710678118654752),
                         T(0.92387953251128676), T(1)};
  constexpr T kCosine[] = {T(1), T(0.92387953251128676), T(0.70710678118654752),
                           T(0.38268343236508977), T(0)};
  constexpr unsigned kHalf = CylinderSide::kHalf;
  const Real inverse = Real(1) / s.rho;
  for (unsigned i = 0; i <= kHalf; ++i) {
    const Real chord = Real(kCosine[i]), sine = kSine[i] * inverse;
    const Real cosine = sqrt(fma(chord, chord, s.gap)) * inverse;
    s.azimuth[i] = atan2(sine, cosine);
    s.value[kHalf + i] = side_line(s, sine, cosine, chord).weight;
    if (i > 0) s.value[kHalf - i] = side_line(s, -sine, cosine, chord).weight;
  }
  s.solid_angle = Real(0);
  for (unsigned i = 0; i + 1 < CylinderSide::kNodes; ++i) {
    s.solid_angle = fma(T(0.5) * (s.value[i] + s.value[i + 1]),
                        azimuth_of_node(s, i + 1) - azimuth_of_node(s, i), s.solid_angle);
  }
}

/// The near line in the direction (x, y) of the frame, whose length is any.
inline SideLine side_line_toward(const CylinderSide& s, Real x, Real y) {
  const Real length2 = fma(x, x, y * y);
  const Real inverse = Real(1) / sqrt(select(length2 > Real(0), length2, Real(1)));
  const Real sine = y * inverse, k = s.rho * sine;
  return side_line(s, sine, x * inverse, safe_sqrt((Real(1) - k) * (Real(1) + k)));
}

/// Density in solid angle of a direction with these coordinates (of any length) in the frame.
inline Real pdf_cylinder_side(const CylinderSide& s, Real x, Real y) {
  const Real end = s.azimuth[CylinderSide::kHalf];
  const Real psi = clamp(atan2(y, x), -end, end);
  Real value(0);
  for (unsigned i = 0; i + 1 < CylinderSide::kNodes; ++i) {
    const Real low = azimuth_of_node(s, i), high = azimuth_of_node(s, i + 1);
    const Real share = (psi - low) / (high - low);
    value = select(psi >= low, fma(share, s.value[i + 1] - s.value[i], s.value[i]), value);
  }
  return value / (s.solid_angle * side_line_toward(s, x, y).weight);
}

/// A sampled direction and where it meets the side.
struct SideSample {
  Vec d;  ///< unit
  Real distance;
  Real normal_x, normal_y;  ///< unit, in the frame
};

inline SideSample sample_cylinder_side(const CylinderSide& s, Vec2 u) {
  // The bin that u.x falls into, and how far.
  const Real target = u.x * s.solid_angle;
  Real behind(0), low(0), high(0), value(1), next(1), rest(0);
  for (unsigned i = 0; i + 1 < CylinderSide::kNodes; ++i) {
    const Real a = azimuth_of_node(s, i), b = azimuth_of_node(s, i + 1);
    const Mask m = target >= behind;
    low = select(m, a, low);
    high = select(m, b, high);
    value = select(m, s.value[i], value);
    next = select(m, s.value[i + 1], next);
    rest = select(m, target - behind, rest);
    behind = fma(T(0.5) * (s.value[i] + s.value[i + 1]), b - a, behind);
  }
  const Real slope = (next - value) / (high - low);
  const Real root = safe_sqrt(fma(value, value, T(2) * slope * rest));
  const Real psi = min(low + T(2) * rest / (value + root), high);
  Real sine, cosine;
  sincos(psi, sine, cosine);
  const SideLine line = side_line_toward(s, cosine, sine);

  // sin(e), from its distance to the nearer end of [-1, 1]: of a line along the axis both of its
  // ends are near those.
  const Real run2 = line.run * line.run;
  const Real low_rest = run2 / (line.slant_low * (line.slant_low + abs(line.low)));
  const Real high_rest = run2 / (line.slant_high * (line.slant_high + abs(line.high)));
  const Real from_low = fma(u.y, line.sines, low_rest);
  const Real from_high = fma(Real(1) - u.y, line.sines, high_rest);
  const Mask over = line.low > Real(0);
  const Mask down = line.high < Real(0) || (!over && from_low < from_high);
  const Real one_less = select(down, from_low, from_high);
  const Real up = select(down, one_less - Real(1), Real(1) - one_less);
  const Real level = safe_sqrt(one_less * (T(2) - one_less));
  SideSample r;
  r.d = madd(line.toward, level, s.axis * up);
  r.distance = line.run / level;
  // From the axis, in the frame: -rho x, and the way to the near line.
  const Real k = s.rho * sine;
  const Real near = s.gap / fma(s.rho, cosine, safe_sqrt((Real(1) - k) * (Real(1) + k)));
  const Real x = fma(near, cosine, -s.rho), y = near * sine;
  const Real inverse = Real(1) / sqrt(fma(x, x, y * y));
  r.normal_x = x * inverse;
  r.normal_y = y * inverse;
  return r;
}

LIGHTBENCH_KERNEL_END
