#pragma once
// Nearly uniform sampling of the solid angle of an elliptic cone: what a disc, an ellipse or an
// ellipsoid fills of the view.
//
// Polar coordinates around the cone's axis. A direction of azimuth phi is inside up to the polar
// angle theta(phi), with cot^2 theta = g(phi) = cos^2 phi cot^2 a + sin^2 phi cot^2 b for the half
// angles a and b along the cone's principal planes. cos(theta) is uniform up to there; phi is that
// of a uniform point of the ellipse with semi-axes sin(a/2) and sin(b/2), which is what the equal
// area (Lambert) projection makes of the cone in its principal planes and nearly so between them.
// So all samples are inside, and their exactly known density is within 20 % of 1 / solid angle for
// the flattest cones and nearly constant for others. Guillen et al. (EGSR 2017) make it constant by
// tables of elliptic integrals.

#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

struct SphericalEllipse {
  Vec x, y, z;          ///< unit, along the principal planes and the axis
  Real cot2_a, cot2_b;  ///< cot^2
  Real half_a, half_b;  ///< sin(a/2), sin(b/2)
};

inline SphericalEllipse select(Mask m, const SphericalEllipse& a, const SphericalEllipse& b) {
  return {select(m, a.x, b.x),           select(m, a.y, b.y),
          select(m, a.z, b.z),           select(m, a.cot2_a, b.cot2_a),
          select(m, a.cot2_b, b.cot2_b), select(m, a.half_a, b.half_a),
          select(m, a.half_b, b.half_b)};
}

/// 1 - cos(theta), for cot^2(theta) = g.
inline Real cap_of_rim(Real g) { return Real(1) / ((Real(1) + g) + sqrt(g * (Real(1) + g))); }

inline SphericalEllipse spherical_ellipse(Vec x, Vec y, Vec z, Real cot2_a, Real cot2_b) {
  return {x,
          y,
          z,
          cot2_a,
          cot2_b,
          sqrt(T(0.5) * cap_of_rim(cot2_a)),
          sqrt(T(0.5) * cap_of_rim(cot2_b))};
}

/// Its solid angle, too large by up to 20 % for the flattest cones.
inline Real solid_angle_about(const SphericalEllipse& e) {
  return T(4) * kPi * e.half_a * e.half_b;
}

/// What the cone is like at an azimuth, given by the coordinates (p, q) of a vector across the axis
/// that is not 0.
struct Azimuth {
  Real inverse2;  ///< 1 / the square of that vector's length
  Real cap;       ///< 1 - cos(theta) of the rim
  Real pdf;       ///< of all directions there, solid angle
};
inline Azimuth azimuth_of(const SphericalEllipse& e, Real p, Real q) {
  const Real pp = p * p, qq = q * q;
  const Real inverse2 = Real(1) / (pp + qq);
  const Real cap = cap_of_rim(fma(pp, e.cot2_a, qq * e.cot2_b) * inverse2);
  const Real aa = e.half_a * e.half_a, bb = e.half_b * e.half_b;
  const Real pdf = e.half_a * e.half_b / (fma(pp, bb, qq * aa) * inverse2);
  return {inverse2, cap, kInvPi * T(0.5) * pdf / cap};
}

/// A unit direction and its density, from a point k of the unit disk.
struct EllipseSample {
  Vec d;
  Real pdf;
};
inline EllipseSample sample_spherical_ellipse(const SphericalEllipse& e, Vec2 k) {
  const Real along = e.half_a * k.x, q = e.half_b * k.y;
  // On the axis, or so near that the square is 0, any azimuth will do.
  const Real p = select(fma(along, along, q * q) > Real(0), along, Real(1));
  const Azimuth at = azimuth_of(e, p, q);
  const Real drop = fma(k.x, k.x, k.y * k.y) * at.cap;
  const Real sine = safe_sqrt(drop * (T(2) - drop)) * sqrt(at.inverse2);
  return {normalize(madd(e.x, p * sine, madd(e.y, q * sine, e.z * (Real(1) - drop)))), at.pdf};
}

/// Density of unit direction d within the cone.
inline Real pdf_spherical_ellipse(const SphericalEllipse& e, Vec d) {
  const Real p = dot(d, e.x), q = dot(d, e.y);
  // Rounding alone chooses the azimuth of directions along the axis.
  constexpr T kAxis = T(64) * kEpsilon;
  return azimuth_of(e, select(max(abs(p), abs(q)) < Real(kAxis), Real(1), p), q).pdf;
}

/// The circle of unit normal n and the given radius around 0, seen from f, which is
/// `signed_height` above its plane (0 does not work). Its cone is symmetric to the plane through
/// its axis and the point; there it lies between the nearest and the farthest point of the rim, at
/// distances r0 and r1. sin(b) = 2 radius / (r0 + r1). Not for points in the circle's plane.
inline SphericalEllipse spherical_ellipse_of_circle(Vec f, Real signed_height, Vec n, Real radius) {
  const Real height = abs(signed_height);
  const Vec level = madd(n, -dot(f, n), f);
  const Real rho = length(level);
  const Mask off_axis = rho > Real(0);
  const Vec inward =
      select(off_axis, level * (Real(-1) / select(off_axis, rho, Real(1))), Frame(n).x);
  const Vec down = n * -copysign(Real(1), signed_height);
  const Real l0 = rho - radius, l1 = rho + radius;
  const Real hh = height * height;
  const Real r0 = sqrt(fma(l0, l0, hh)), r1 = sqrt(fma(l1, l1, hh));
  // cos and sin of a from those of 2a, without cancellation.
  const Real rr = r0 * r1, cosine = fma(l0, l1, hh);
  const Real large = sqrt((rr + abs(cosine)) / (T(2) * rr));
  const Real small = radius * height / (rr * large);
  const Mask narrow = cosine > Real(0);
  const Real cos_a = select(narrow, large, small), sin_a = select(narrow, small, large);
  const Real cot_b = sqrt(rr) * cos_a / radius;
  // The bisector of the directions to the two points, from their sum or their difference.
  const Mask beside = l0 > Real(0);
  const Real in = select(beside, fma(l0, r1, l1 * r0), height * (r1 - r0));
  const Real out = select(beside, height * (r0 + r1), fma(l1, r0, -(l0 * r1)));
  const Real inverse = Real(1) / sqrt(fma(in, in, out * out));
  const Vec x = (inward * out - down * in) * inverse, z = (inward * in + down * out) * inverse;
  return spherical_ellipse(x, cross(z, x), z, square(cos_a / sin_a), cot_b * cot_b);
}

/// Principal axes (unit) of an ellipsoid around 0 and the squares of its semi-axes, the largest
/// first; an ellipse if the last is 0.
struct PrincipalAxes {
  Vec a, b, c;
  Vec squares;
};

/// cos and sin of half the angle atan2(y, x), in (-pi/2, pi/2].
inline Vec2 half_angle(Real x, Real y) {
  const Real size = sqrt(fma(x, x, y * y));
  const Mask any_angle = size == Real(0);
  const Real inverse = Real(1) / select(any_angle, Real(1), size);
  const Real cosine = select(any_angle, Real(1), x * inverse);
  const Real large = sqrt(T(0.5) * (Real(1) + abs(cosine)));
  const Real small = T(0.5) * abs(y) * inverse / large;
  const Mask acute = cosine > Real(0);
  return {select(acute, large, small), copysign(select(acute, small, large), y)};
}

/// Of the ellipse with conjugate semi-axes u and v.
inline PrincipalAxes axes_of_ellipse(Vec u, Vec v) {
  const Vec2 turn = half_angle(length_squared(u) - length_squared(v), T(2) * dot(u, v));
  const Vec a = madd(u, turn.x, v * turn.y), b = madd(v, turn.x, u * -turn.y);
  const Real aa = length_squared(a), bb = length_squared(b);
  const Vec to_a = a * (Real(1) / sqrt(aa)), to_b = b * (Real(1) / sqrt(bb));
  return {to_a, to_b, cross(to_a, to_b), {aa, bb, Real(0)}};
}

/// The cone that touches an ellipsoid from outside, from the point q on its axes. `depth` is the
/// product of the squares of the semi-axes with sum q_i^2 / s_i - 1; of an ellipse, the product of
/// its two with q_z^2, which must not be 0.
///
/// The cone's axes are the normals of the three quadrics through q that are confocal to the
/// ellipsoid, sum q_i^2 / (s_i + k) = 1, and its equation there is the sum of x_i^2 / k_i = 0
/// (Salmon, Analytic geometry of three dimensions). k1 > 0 > k2 > k3.
inline SphericalEllipse spherical_ellipse_of_ellipsoid(const PrincipalAxes& axes, Vec q,
                                                       Real depth) {
  const Vec s = axes.squares, qq = q * q;
  // k1 from below: that of the spheroid with the two larger axes equal, then Newton's steps on the
  // reciprocal of the sum, which is nearly linear.
  const Real linear = s.x + s.z - (qq.x + qq.y + qq.z);
  const Real constant = s.z * (s.x - qq.x - qq.y) - qq.z * s.x;
  const Real root = safe_sqrt(fma(linear, linear, T(-4) * constant));
  Real k1 =
      max(select(linear > Real(0), T(-2) * constant / (linear + root), T(0.5) * (root - linear)),
          Real(0));
  // Near the rim of a long ellipse that takes up to sixteen steps. Each lane stops by itself, so
  // that its result does not depend on the others.
  Mask moving = true;
  for (int i = 0; i < 32 && any(moving); ++i) {
    const Vec w{Real(1) / (s.x + k1), Real(1) / (s.y + k1), Real(1) / (s.z + k1)};
    const Vec v = qq * w;
    const Real sum = v.x + v.y + v.z;
    const Real step = sum * (sum - Real(1)) / dot(v, w);
    k1 = select(moving, max(k1 + step, Real(0)), k1);
    moving = moving && abs(step) > T(4) * kEpsilon * k1;
  }
  const Vec toward = -normalize(Vec{q.x / (s.x + k1), q.y / (s.y + k1), q.z / (s.z + k1)});
  // The others from their product and their sum, the form of which depends on the distance.
  const Real product = depth / k1;
  const Vec pairs{s.y * s.z, s.z * s.x, s.x * s.y};
  const Real mixed =
      pairs.x + pairs.y + pairs.z - (qq.x * (s.y + s.z) + qq.y * (s.z + s.x) + qq.z * (s.x + s.y));
  const Real sum =
      select(k1 > s.x, (product - mixed) / k1, s.x + s.y + s.z + k1 - (qq.x + qq.y + qq.z));
  const Real half = T(0.5) * sum;
  const Real k3 = half + safe_sqrt(fma(half, half, -product)), k2 = product / k3;
  // The wide and the narrow direction across the axis, by the cone's quadratic form there.
  const Frame frame(toward);
  const auto form = [&](Vec d, Vec e) {
    return dot(s, cross(q, d) * cross(q, e)) - dot(pairs, d * e);
  };
  const Vec2 turn =
      half_angle(form(frame.x, frame.x) - form(frame.y, frame.y), T(2) * form(frame.x, frame.y));
  const Vec narrow = madd(frame.x, turn.x, frame.y * turn.y), wide = cross(narrow, toward);
  const auto to_world = [&](Vec v) { return madd(axes.a, v.x, madd(axes.b, v.y, axes.c * v.z)); };
  return spherical_ellipse(to_world(wide), to_world(narrow), to_world(toward), k1 / k3, k1 / k2);
}

LIGHTBENCH_KERNEL_END
