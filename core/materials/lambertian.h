#pragma once
// Ideal diffuse reflection.

#include "core/materials/bsdf.h"

LIGHTBENCH_KERNEL_BEGIN

inline BsdfSample sample_lambertian(Vec albedo, const Frame& frame, Vec2 u) {
  const Vec local = square_to_cosine_hemisphere(u);
  return {frame.to_world(local), albedo, pdf_cosine_hemisphere(local.z), local.z > Real(0),
          Mask(false)};
}

inline BsdfValue eval_lambertian(Vec albedo, Vec n, Vec wi) {
  const Real pdf = pdf_cosine_hemisphere(dot(n, wi));
  return {albedo * pdf, pdf};
}

LIGHTBENCH_KERNEL_END
