#pragma once
// Rough metal: GGX microfacets with height-correlated Smith masking and a constant reflectance (as
// the smooth metal has), sampled by visible normals through a spherical cap (Dupuy & Benyoub, CGF
// 42:8, 2023; the density is Heitz's, JCGT 7:4, 2018). Single scattering: rough metals lose some
// energy.

#include "core/materials/bsdf.h"

LIGHTBENCH_KERNEL_BEGIN

/// Normal distribution at a half vector of any length, by the squares of its parts across and along
/// the normal. Not by 1 - cos^2, which has no digits left at small alpha.
inline Real ggx_d(Real across2, Real along2, Real alpha) {
  const Real alpha2 = alpha * alpha;
  const Real k = fma(across2, Real(1) / alpha2, along2) / (across2 + along2);
  return kInvPi / (alpha2 * k * k);
}

/// Square of the part across the normal of the sum of two unit directions; `along` is that along
/// it. At grazing angles rounded directions cancel to a sum that is off by as much as a narrow lobe
/// is wide: there its part along their difference is taken from the cosines, as unit vectors have
/// it.
inline Real half_across2(const Frame& frame, Vec wo, Vec wi, Real cos_o, Real cos_i, Real along) {
  const Vec sum = wo + wi, difference = wo - wi;
  const Real sx = dot(sum, frame.x), sy = dot(sum, frame.y);
  const Real dx = dot(difference, frame.x), dy = dot(difference, frame.y);
  const Real d2 = fma(dx, dx, dy * dy);
  const Real with = (cos_i - cos_o) * along, beside = sx * dy - sy * dx;
  return select(along * along < d2, fma(with, with, beside * beside) / d2, fma(sx, sx, sy * sy));
}

/// Smith's Lambda of a unit direction at this cosine to the normal.
inline Real ggx_lambda(Real cosine, Real alpha) {
  const Real cosine2 = max(cosine * cosine, Real(T(1e-30)));
  const Real tangent2 = (Real(1) - cosine2) / cosine2;
  return (sqrt(fma(alpha * alpha, tangent2, Real(1))) - Real(1)) * T(0.5);
}

/// pdf of wi under visible-normal sampling.
inline BsdfValue eval_ggx(Vec reflectance, Real alpha, const Frame& frame, Vec wo, Vec wi) {
  const Real cos_o = dot(wo, frame.z), cos_i = dot(wi, frame.z), along = cos_o + cos_i;
  const Real d = ggx_d(half_across2(frame, wo, wi, cos_o, cos_i, along), along * along, alpha);
  const Real lambda_o = ggx_lambda(cos_o, alpha), lambda_i = ggx_lambda(cos_i, alpha);
  const Real common = d / (T(4) * cos_o);
  BsdfValue v;
  v.pdf = common / (Real(1) + lambda_o);
  v.f = reflectance * (common / (Real(1) + lambda_o + lambda_i));
  const Mask above = cos_o > Real(0) && cos_i > Real(0);
  v.pdf = select(above, v.pdf, Real(0));
  v.f = select(above, v.f, Vec(Real(0)));
  return v;
}

inline BsdfSample sample_ggx(Vec reflectance, Real alpha, const Frame& frame, Vec wo, Vec2 u) {
  // Stretch to the hemisphere configuration, sample the cap that the mirror direction fills,
  // unstretch.
  const Vec local = frame.to_local(wo);
  const Vec stretched = normalize({local.x * alpha, local.y * alpha, local.z});
  const Real z = fma(Real(1) - u.y, Real(1) + stretched.z, -stretched.z);
  const Real r = safe_sqrt(Real(1) - z * z);
  Real s, c;
  sincos(u.x * kTwoPi, s, c);
  const Vec hs = Vec{r * c, r * s, z} + stretched;
  const Vec h = normalize({hs.x * alpha, hs.y * alpha, max(hs.z, Real(0))});
  BsdfSample b;
  b.wi = reflect(wo, frame.to_world(h));
  const BsdfValue v = eval_ggx(reflectance, alpha, frame, wo, b.wi);
  b.pdf = v.pdf;
  b.valid = v.pdf > Real(0) && v.pdf < Real(kInfinity);
  const Real lambda_o = ggx_lambda(local.z, alpha);
  const Real lambda_i = ggx_lambda(dot(b.wi, frame.z), alpha);
  b.weight = reflectance * ((Real(1) + lambda_o) / (Real(1) + lambda_o + lambda_i));
  b.delta = false;
  return b;
}

LIGHTBENCH_KERNEL_END
