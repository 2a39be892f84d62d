#pragma once
// What all lobes share. Directions are unit and point away from the surface; `n` is the shading
// normal on the side of wo. Values include the cosine: f * |cos(theta_i)|; pdfs are in solid angle.
//
// To add a lobe: a file here with sample, eval and pdf; a BsdfKind; a mask in scatter().

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"
#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// The material of each lane's surface, textures applied. A row of the material table is
///   0 kind, 1..3 base colour, 4 its texture (-1 none), 5 fuzz, 6 GGX alpha, 7 ior,
///   8..10 emission, 11 its texture (-1 none), 12 two-sided.
struct Material {
  Int kind;
  Vec base_color;
  Real fuzz, alpha, ior;
};

/// Value and density of a pair of directions.
struct BsdfValue {
  Vec f;  ///< f * |cos|
  Real pdf;
};

/// A sampled direction; weight = f * |cos| / pdf. Delta lobes have no density (pdf is then unused).
struct BsdfSample {
  Vec wi, weight;
  Real pdf;
  Mask valid, delta;
};

inline Vec reflect(Vec w, Vec n) { return madd(n, T(2) * dot(w, n), -w); }

LIGHTBENCH_KERNEL_END
