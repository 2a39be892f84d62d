#pragma once
// Uniform sampling of the solid angle of a parallelogram: two spherical triangles around the first
// corner, swept by one fan. Urena, Fajardo & King's map (EGSR 2013) has no corner to turn around,
// but takes angle sums that float loses in the distance, needs right angles, and its noise was the
// same (docs/performance.md).

#include "core/sampling/spherical_triangle.h"

LIGHTBENCH_KERNEL_BEGIN

/// The parallelogram corner + [0,1] u + [0,1] v, seen from a point.
struct SphericalParallelogram {
  Vec corner, u, v;  ///< the corner relative to the point
  Real height;       ///< |corner . u x v|
  Real first;        ///< half the solid angle of the triangle corner, + u, + u + v
  Real half;         ///< half the solid angle of the whole, 0 to pi
};

inline SphericalParallelogram select(Mask m, const SphericalParallelogram& a,
                                     const SphericalParallelogram& b) {
  return {select(m, a.corner, b.corner), select(m, a.u, b.u),         select(m, a.v, b.v),
          select(m, a.height, b.height), select(m, a.first, b.first), select(m, a.half, b.half)};
}

/// `corner_lost` is what rounding took from the corner.
inline SphericalParallelogram spherical_parallelogram(Vec corner, Vec corner_lost, Vec u, Vec v) {
  SphericalParallelogram s{corner, u, v, Real(0), Real(0), Real(0)};
  const Vec b = corner + u, c = b + v, d = corner + v;
  const Real la = length(corner), lb = length(b), lc = length(c), ld = length(d);
  s.height = abs(triple_product(corner, corner_lost, u, v));
  s.first = half_solid_angle(corner, b, c, la, lb, lc, s.height);
  s.half = s.first + half_solid_angle(corner, c, d, la, lc, ld, s.height);
  return s;
}

/// Unit direction. `swept` in [0, half) goes around the corner, v in [0,1) outward from it.
inline Vec sample_spherical_parallelogram(const SphericalParallelogram& s, Real swept, Real v) {
  const Mask second = swept >= s.first;
  const Vec diagonal = s.u + s.v;
  const Vec pq = select(second, diagonal, s.u), pr = select(second, s.v, diagonal);
  return sample_spherical_fan(s.corner, s.corner + pq, pq, pr,
                              select(second, swept - s.first, swept), v);
}

LIGHTBENCH_KERNEL_END
