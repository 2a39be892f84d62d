#pragma once
// The books' fuzzy metal: the mirror direction plus `fuzz` times a uniform point of the unit ball,
// normalised; absorbed below the surface. Not reciprocal. Its density follows from the chord that a
// direction cuts through the ball, so it takes part in multiple importance sampling:
//   pdf(w) = integral over the chord of t^2 dt / (4/3 pi fuzz^3) = (t1^3 - t0^3) / (4 pi fuzz^3).

#include "core/materials/bsdf.h"

LIGHTBENCH_KERNEL_BEGIN

inline Real pdf_fuzz(Vec mirror, Real fuzz, Vec wi) {
  const Real b = dot(mirror, wi);
  // Squared distance of the ball's centre from the direction's line, without cancellation at b = 1.
  const Real off = length_squared(cross(mirror, wi));
  const Real h2 = fuzz * fuzz - off;
  const Real h = safe_sqrt(h2);
  const Real t1 = b + h, t0 = max(b - h, Real(0));
  const Real chord = t1 - t0;
  const Mask meets = h2 > Real(0) && t1 > Real(0);
  const Real cubes = chord * (t1 * t1 + t1 * t0 + t0 * t0);
  return select(meets, cubes * (kInvPi * T(0.25)) / (fuzz * fuzz * fuzz), Real(0));
}

inline BsdfSample sample_fuzz(Vec albedo, Real fuzz, Vec n, Vec wo, Vec2 u, Real u_radius) {
  const Vec mirror = reflect(wo, n);
  // Cube root of a uniform number by exp(log/3): the radius of a uniform point of the ball.
  const Real radius = exp(log(max(u_radius, Real(T(1e-12)))) * T(1.0 / 3));
  const Vec w = madd(square_to_sphere(u), fuzz * radius, mirror);
  const Real squared = length_squared(w);
  BsdfSample s;
  s.wi = w * (Real(1) / sqrt(max(squared, Real(T(1e-20)))));
  s.weight = albedo;
  s.pdf = pdf_fuzz(mirror, fuzz, s.wi);
  s.valid = squared > Real(T(1e-20)) && dot(s.wi, n) > Real(0) && s.pdf > Real(0);
  s.delta = false;
  return s;
}

inline BsdfValue eval_fuzz(Vec albedo, Real fuzz, Vec n, Vec wo, Vec wi) {
  const Real pdf = pdf_fuzz(reflect(wo, n), fuzz, wi);
  return {select(dot(wi, n) > Real(0), albedo * pdf, Vec(Real(0))), pdf};
}

LIGHTBENCH_KERNEL_END
