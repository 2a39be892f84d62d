#pragma once
// Smooth glass: exact unpolarised Fresnel reflection and refraction by Snell's law. Radiance
// changes by the square of the relative index across the surface.

#include "core/materials/bsdf.h"

LIGHTBENCH_KERNEL_BEGIN

/// Reflectance for cosine > 0 on the side the light comes from, eta = index beyond / index here.
/// Also gives the cosine beyond (0 in total reflection, where the result is 1).
inline Real fresnel_dielectric(Real cosine, Real eta, Real& cosine_beyond) {
  const Real inverse = Real(1) / eta;
  const Real sine2 = (Real(1) - cosine * cosine) * inverse * inverse;
  const Mask total = sine2 >= Real(1);
  cosine_beyond = safe_sqrt(Real(1) - sine2);
  const Real parallel = (eta * cosine - cosine_beyond) / (eta * cosine + cosine_beyond);
  const Real perpendicular = (cosine - eta * cosine_beyond) / (cosine + eta * cosine_beyond);
  return select(total, Real(1), (parallel * parallel + perpendicular * perpendicular) * T(0.5));
}

/// `entering`: wo is outside. n on the side of wo. `tint` multiplies what passes through.
inline BsdfSample sample_dielectric(Vec tint, Real ior, Mask entering, Vec n, Vec wo, Real u) {
  const Real eta = select(entering, ior, Real(1) / ior);
  const Real cosine = min(dot(n, wo), Real(1));
  Real beyond;
  const Real reflectance = fresnel_dielectric(cosine, eta, beyond);
  const Mask reflected = u < reflectance;
  const Real inverse = Real(1) / eta;
  const Vec refracted = normalize(madd(n, fma(cosine, inverse, -beyond), -wo * inverse));
  BsdfSample s;
  s.wi = select(reflected, reflect(wo, n), refracted);
  s.weight = select(reflected, Vec(Real(1)), tint * (inverse * inverse));
  s.pdf = select(reflected, reflectance, Real(1) - reflectance);
  s.valid = cosine > Real(0);
  s.delta = true;
  return s;
}

LIGHTBENCH_KERNEL_END
