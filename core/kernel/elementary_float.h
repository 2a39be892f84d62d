#pragma once
// Elementary functions of the float kernels, the same operations for every width. Polynomials are
// the Cephes single-precision ones (S. Moshier, public domain), good to a few ulp in the range
// stated; tests/unit/elementary_test.cpp checks them against the C library.

LIGHTBENCH_KERNEL_BEGIN

/// Clamped to x in [-87.3, 88].
inline Real exp(Real x) {
  x = min(max(x, Real(-87.3F)), Real(88.0F));
  const Real n = floor(fma(x, 1.44269504088896341F, 0.5F));
  Real r = fma(n, -0.693359375F, x);
  r = fma(n, 2.12194440e-4F, r);
  Real p = fma(r, 1.9875691500e-4F, 1.3981999507e-3F);
  p = fma(p, r, 8.3334519073e-3F);
  p = fma(p, r, 4.1665795894e-2F);
  p = fma(p, r, 1.6666665459e-1F);
  p = fma(p, r, 5.0000001201e-1F);
  p = fma(p, r * r, r) + 1.0F;
  return p * as_real((to_int(n) + Int(127U)) << 23);
}

/// Natural logarithm of a normal x > 0.
inline Real log(Real x) {
  // Mantissa in [sqrt(1/2), sqrt(2)), exponent to match.
  const Int shifted = as_int(x) + Int(0x3f800000U - 0x3f3504f3U);
  const Real e = to_real((shifted >> 23) - Int(127U));
  const Real m = as_real((shifted & Int(0x007fffffU)) + Int(0x3f3504f3U)) - 1.0F;
  const Real z = m * m;
  Real p = fma(m, 7.0376836292e-2F, -1.1514610310e-1F);
  p = fma(p, m, 1.1676998740e-1F);
  p = fma(p, m, -1.2420140846e-1F);
  p = fma(p, m, 1.4249322787e-1F);
  p = fma(p, m, -1.6668057665e-1F);
  p = fma(p, m, 2.0000714765e-1F);
  p = fma(p, m, -2.4999993993e-1F);
  p = fma(p, m, 3.3333331174e-1F);
  Real y = p * m * z;
  y = fma(e, -2.12194440e-4F, y);
  y = fma(z, -0.5F, y);
  return fma(e, 0.693359375F, m + y);
}

/// -log(1 - u), u in [0,1). A 24-bit u makes 1 - u exact, so nothing is lost near 0.
inline Real exponential(Real u) { return -log(1.0F - u); }

/// sin(r) and cos(r) for |r| <= pi/4.
inline void sincos_octant(Real r, Real& s, Real& c) {
  const Real z = r * r;
  s = fma(z, -1.9515295891e-4F, 8.3321608736e-3F);
  s = fma(s, z, -1.6666654611e-1F);
  s = fma(s * z, r, r);
  c = fma(z, 2.443315711809948e-5F, -1.388731625493765e-3F);
  c = fma(c, z, 4.166664568298827e-2F);
  c = fma(c * z, z, fma(z, -0.5F, 1.0F));
}

/// sin(x) and cos(x) for |x| < 8192: reduction to [-pi/4, pi/4] in three steps.
inline void sincos(Real x, Real& s, Real& c) {
  const Real n = floor(fma(x, 0.636619772367581F, 0.5F));
  const Int quadrant = to_int(n);
  Real r = fma(n, -1.5703125F, x);
  r = fma(n, -4.837512969970703125e-4F, r);
  r = fma(n, -7.54978995489188216e-8F, r);
  Real ps, pc;
  sincos_octant(r, ps, pc);
  const Mask swap = (quadrant & Int(1U)) == Int(1U);
  const Real a = select(swap, pc, ps);
  const Real b = select(swap, ps, pc);
  s = select((quadrant & Int(2U)) == Int(2U), -a, a);
  c = select(((quadrant + Int(1U)) & Int(2U)) == Int(2U), -b, b);
}
inline Real sin(Real x) {
  Real s, c;
  sincos(x, s, c);
  return s;
}
inline Real cos(Real x) {
  Real s, c;
  sincos(x, s, c);
  return c;
}

/// All quadrants; atan2(0, 0) = 0.
inline Real atan2(Real y, Real x) {
  const Real ax = abs(x), ay = abs(y);
  const Real big = max(ax, ay), small = min(ax, ay);
  const Real q = small / max(big, Real(1e-37F));
  // atan on [0,1]: above tan(pi/8) by the identity atan q = pi/4 + atan((q-1)/(q+1)).
  const Mask upper = q > Real(0.4142135623730950F);
  const Real r = select(upper, (q - 1.0F) / (q + 1.0F), q);
  const Real z = r * r;
  Real p = fma(z, 8.05374449538e-2F, -1.38776856032e-1F);
  p = fma(p, z, 1.99777106478e-1F);
  p = fma(p, z, -3.33329491539e-1F);
  Real a = fma(p * z, r, r) + select(upper, Real(0.785398163397448F), Real(0.0F));
  a = select(ay > ax, Real(1.57079632679490F) - a, a);
  a = select(x < Real(0.0F), Real(3.14159265358979F) - a, a);
  return copysign(a, y);
}

/// x in [-1,1] (clamped); half-angle form, accurate near both ends.
inline Real acos(Real x) {
  x = min(max(x, Real(-1.0F)), Real(1.0F));
  return 2.0F * atan2(sqrt(1.0F - x), sqrt(1.0F + x));
}

LIGHTBENCH_KERNEL_END
