#pragma once
// Uniform sampling of the solid angle of a rectangle (Urena, Fajardo, King, EGSR 2013).

#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// The rectangle corner + [0,1] ex + [0,1] ey (ex perpendicular to ey), seen from a point.
struct SphericalRectangle {
  Vec x, y, z;
  Real x0, y0, z0, x1, y1;
  Real b0, b1, k, solid_angle;
};

inline SphericalRectangle spherical_rectangle(Vec from, Vec corner, Vec ex, Vec ey) {
  SphericalRectangle q;
  const Real lx = length(ex), ly = length(ey);
  q.x = ex * (Real(1) / lx);
  q.y = ey * (Real(1) / ly);
  q.z = cross(q.x, q.y);
  const Vec d = corner - from;
  const Real height = dot(d, q.z);
  q.z = select(height > Real(0), -q.z, q.z);
  q.z0 = -abs(height);
  q.x0 = dot(d, q.x);
  q.y0 = dot(d, q.y);
  q.x1 = q.x0 + lx;
  q.y1 = q.y0 + ly;
  // z components of the normals of the four planes through the edges and the point.
  const Real zz = q.z0 * q.z0;
  const Real n0 = -q.y0 / sqrt(zz + q.y0 * q.y0);
  const Real n1 = q.x1 / sqrt(zz + q.x1 * q.x1);
  const Real n2 = q.y1 / sqrt(zz + q.y1 * q.y1);
  const Real n3 = -q.x0 / sqrt(zz + q.x0 * q.x0);
  q.b0 = n0;
  q.b1 = n2;
  q.k = Real(kTwoPi) - acos(-n2 * n3) - acos(-n3 * n0);
  q.solid_angle = acos(-n0 * n1) + acos(-n1 * n2) - q.k;
  // A point in the rectangle's plane sees nothing of it (and n0..n3 may be 0/0 there).
  q.solid_angle = select(height == Real(0), Real(0), q.solid_angle);
  return q;
}

/// The sampled point relative to the reference point; its direction has pdf 1 / solid_angle.
inline Vec sample_spherical_rectangle(const SphericalRectangle& q, Vec2 u) {
  Real s, c;
  sincos(fma(u.x, q.solid_angle, q.k), s, c);
  const Real fu = (c * q.b0 - q.b1) / s;
  const Real cu = clamp(copysign(Real(1), fu) / sqrt(fu * fu + q.b0 * q.b0), Real(-1 + kEpsilon),
                        Real(1 - kEpsilon));
  const Real xu = clamp(-(cu * q.z0) / sqrt(Real(1) - cu * cu), q.x0, q.x1);
  const Real d2 = xu * xu + q.z0 * q.z0;
  const Real h0 = q.y0 / sqrt(d2 + q.y0 * q.y0);
  const Real h1 = q.y1 / sqrt(d2 + q.y1 * q.y1);
  const Real hv = fma(u.y, h1 - h0, h0);
  const Real rest = Real(1) - hv * hv;
  const Real yv = select(rest > Real(T(1e-6)),
                         clamp(hv * sqrt(d2 / max(rest, Real(T(1e-6)))), q.y0, q.y1), q.y1);
  return madd(q.x, xu, madd(q.y, yv, q.z * q.z0));
}

LIGHTBENCH_KERNEL_END
