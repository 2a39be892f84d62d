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

/// `r` is a Row or a LaneRow.
inline Material material_at(const auto& r) {
  return {to_int(r[0]), r.vec(1),        r[5],         r[6],         r[7],
          r.vec(8),     r[12] > Real(0), to_int(r[4]), to_int(r[11])};
}
inline constexpr unsigned kMaterialNumbers = 13;

inline Mask is_textured(const Material& m) {
  return m.base_color_texture != Int(kNoTexture) || m.emission_texture != Int(kNoTexture);
}

/// Reflects and emits nothing.
inline Material black_material() {
  return {Int(0U),      Vec(Real(0)), Real(0),         Real(0),        Real(1),
          Vec(Real(0)), Mask(false),  Int(kNoTexture), Int(kNoTexture)};
}

/// Row `index` of the material table; black where !active.
inline Material materials_of(const SceneView<T>& scene, Int index, Mask active) {
  if (none(active)) return black_material();
  Material m = material_at(scene.material_columns != nullptr
                               ? row_of_columns<kMaterialNumbers>(scene.material_columns, index)
                               : merged_rows<kMaterialNumbers>(index, active, [&](std::uint32_t i) {
                                   return scene.materials + std::size_t{i} * kMaterialStride;
                                 }));
  m.kind = select(active, m.kind, Int(static_cast<std::uint32_t>(BsdfKind::Black)));
  m.emission = select(active, m.emission, Vec(Real(0)));
  return m;
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
