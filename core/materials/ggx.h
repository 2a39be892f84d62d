#pragma once
// Rough metal: GGX microfacets with height-correlated Smith masking and a constant reflectance (as
// the smooth metal has), sampled by visible normals through a spherical cap (Dupuy & Benyoub, CGF
// 42:8, 2023; the density is Heitz's, JCGT 7:4, 2018). Single scattering: rough metals lose some
// energy.

#include "core/materials/bsdf.h"

LIGHTBENCH_KERNEL_BEGIN

/// Normal distribution at the unit half vector h of the local frame. Written with x and y, not 1 -
/// z^2, so that it keeps its precision at small alpha.
inline Real ggx_d(Vec h, Real alpha) {
  const Real a = h.x / alpha, b = h.y / alpha;
  const Real k = fma(a, a, fma(b, b, h.z * h.z));
  return kInvPi / (alpha * alpha * k * k);
}

/// Smith's Lambda.
inline Real ggx_lambda(Vec w, Real alpha) {
  const Real tangent2 = (w.x * w.x + w.y * w.y) / max(w.z * w.z, Real(T(1e-30)));
  return (sqrt(fma(alpha * alpha, tangent2, Real(1))) - Real(1)) * T(0.5);
}

/// Both directions in the local frame, above the surface. pdf of wi under visible-normal sampling.
inline BsdfValue eval_ggx(Vec reflectance, Real alpha, Vec wo, Vec wi) {
  const Vec h = normalize(wo + wi);
  const Real lambda_o = ggx_lambda(wo, alpha), lambda_i = ggx_lambda(wi, alpha);
  const Real common = ggx_d(h, alpha) / (T(4) * wo.z);
  BsdfValue v;
  v.pdf = common / (Real(1) + lambda_o);
  v.f = reflectance * (common / (Real(1) + lambda_o + lambda_i));
  const Mask above = wo.z > Real(0) && wi.z > Real(0);
  v.pdf = select(above, v.pdf, Real(0));
  v.f = select(above, v.f, Vec(Real(0)));
  return v;
}

inline BsdfSample sample_ggx(Vec reflectance, Real alpha, Vec wo, Vec2 u) {
  // Stretch to the hemisphere configuration, sample the cap that the mirror direction fills,
  // unstretch.
  const Vec stretched = normalize({wo.x * alpha, wo.y * alpha, wo.z});
  const Real z = fma(Real(1) - u.y, Real(1) + stretched.z, -stretched.z);
  const Real r = safe_sqrt(Real(1) - z * z);
  Real s, c;
  sincos(u.x * kTwoPi, s, c);
  const Vec hs = Vec{r * c, r * s, z} + stretched;
  const Vec h = normalize({hs.x * alpha, hs.y * alpha, max(hs.z, Real(0))});
  BsdfSample b;
  b.wi = reflect(wo, h);
  const BsdfValue v = eval_ggx(reflectance, alpha, wo, b.wi);
  b.pdf = v.pdf;
  b.valid = v.pdf > Real(0) && v.pdf < Real(kInfinity);
  const Real lambda_o = ggx_lambda(wo, alpha), lambda_i = ggx_lambda(b.wi, alpha);
  b.weight = reflectance * ((Real(1) + lambda_o) / (Real(1) + lambda_o + lambda_i));
  b.delta = false;
  return b;
}

LIGHTBENCH_KERNEL_END
