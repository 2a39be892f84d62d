#pragma once
// What all lobes share. Directions are unit and point away from the surface; `n` is the shading
// normal on the side of wo. Values include the cosine: f * |cos(theta_i)|; pdfs are in solid angle.
//
// To add a lobe: a file here with sample, eval and pdf; a BsdfKind; a mask in scatter().

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"
#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// The material of each lane's surface. A row of the material table is
///   0 kind, 1..3 base colour, 4 its texture (-1 none), 5 fuzz, 6 GGX alpha, 7 ior,
///   8..10 emission, 11 its texture (-1 none), 12 two-sided.
struct Material {
  Int kind;
  Vec base_color;
  Real fuzz, alpha, ior;
  Vec emission;
  Mask two_sided;
  Int base_color_texture, emission_texture;  ///< kNoTexture for none
};
inline constexpr std::uint32_t kNoTexture = 0xffffffffU;

inline bool is_textured(const Row& r) { return r.base[4] >= T(0) || r.base[11] >= T(0); }

inline Material material_at(const Row& r) {
  const T* row = r.base;
  const auto texture = [](T index) {
    return index < T(0) ? kNoTexture : static_cast<std::uint32_t>(index);
  };
  return {Int(static_cast<std::uint32_t>(row[0])),
          r.vec(1),
          r[5],
          r[6],
          r[7],
          r.vec(8),
          Mask(row[12] > T(0)),
          Int(texture(row[4])),
          Int(texture(row[11]))};
}

/// Reflects and emits nothing.
inline Material black_material() {
  return {Int(0U),      Vec(Real(0)), Real(0),         Real(0),        Real(1),
          Vec(Real(0)), Mask(false),  Int(kNoTexture), Int(kNoTexture)};
}

inline void merge(Mask m, const Material& from, Material& into) {
  into.kind = select(m, from.kind, into.kind);
  into.base_color = select(m, from.base_color, into.base_color);
  into.fuzz = select(m, from.fuzz, into.fuzz);
  into.alpha = select(m, from.alpha, into.alpha);
  into.ior = select(m, from.ior, into.ior);
  into.emission = select(m, from.emission, into.emission);
  into.two_sided = select(m, from.two_sided, into.two_sided);
  into.base_color_texture = select(m, from.base_color_texture, into.base_color_texture);
  into.emission_texture = select(m, from.emission_texture, into.emission_texture);
}

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
