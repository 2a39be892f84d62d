#pragma once
// The one switch over lobes: each kind present in the scene is evaluated under a mask and skipped
// when no lane wants it.

#include "core/kernel/uses.h"
#include "core/materials/dielectric.h"
#include "core/materials/fuzz.h"
#include "core/materials/ggx.h"
#include "core/materials/lambertian.h"

LIGHTBENCH_KERNEL_BEGIN

inline Mask is_kind(const Material& m, BsdfKind kind) {
  return m.kind == Int(static_cast<std::uint32_t>(kind));
}

/// True where the material is a pure delta lobe or black: light sampling cannot help there.
inline Mask is_delta_or_black(const Material& m) {
  return is_kind(m, BsdfKind::Mirror) || is_kind(m, BsdfKind::Dielectric) ||
         is_kind(m, BsdfKind::Black);
}

inline void merge(Mask m, const BsdfSample& from, BsdfSample& into) {
  into.wi = select(m, from.wi, into.wi);
  into.weight = select(m, from.weight, into.weight);
  into.pdf = select(m, from.pdf, into.pdf);
  into.valid = select(m, from.valid, into.valid);
  into.delta = select(m, from.delta, into.delta);
}

/// u: the direction, or of glass whether it reflects or refracts; u_fuzz: the fuzz radius.
inline BsdfSample sample_bsdf(const SceneView<T>& scene, const Material& m, const Frame& frame,
                              Vec wo, Mask entering, Vec2 u, Real u_fuzz) {
  BsdfSample s{frame.z, Vec(Real(0)), Real(0), Mask(false), Mask(false)};
  const Mask lambertian = is_kind(m, BsdfKind::Lambertian);
  if (uses(scene, Feature::Lambertian) && any(lambertian)) {
    merge(lambertian, sample_lambertian(m.base_color, frame, u), s);
  }
  const Mask mirror = is_kind(m, BsdfKind::Mirror);
  if (uses(scene, Feature::Mirror) && any(mirror)) {
    const BsdfSample r{reflect(wo, frame.z), m.base_color, Real(1), dot(wo, frame.z) > Real(0),
                       Mask(true)};
    merge(mirror, r, s);
  }
  const Mask fuzz = is_kind(m, BsdfKind::Fuzz);
  if (uses(scene, Feature::Fuzz) && any(fuzz)) {
    merge(fuzz, sample_fuzz(m.base_color, m.fuzz, frame.z, wo, u, u_fuzz), s);
  }
  const Mask ggx = is_kind(m, BsdfKind::Ggx);
  if (uses(scene, Feature::Ggx) && any(ggx)) {
    merge(ggx, sample_ggx(m.base_color, m.alpha, frame, wo, u), s);
  }
  const Mask glass = is_kind(m, BsdfKind::Dielectric);
  if (uses(scene, Feature::Dielectric) && any(glass)) {
    merge(glass, sample_dielectric(m.base_color, m.ior, entering, frame.z, wo, u.x), s);
  }
  // A direction along the surface can round to below it: no opaque material scatters there.
  s.valid = s.valid && (s.delta || dot(s.wi, frame.z) > Real(0));
  return s;
}

/// Non-delta lobes only; zero for the others.
inline BsdfValue eval_bsdf(const SceneView<T>& scene, const Material& m, const Frame& frame, Vec wo,
                           Vec wi) {
  BsdfValue v{Vec(Real(0)), Real(0)};
  const auto merge_value = [&v](Mask mask, const BsdfValue& from) {
    v.f = select(mask, from.f, v.f);
    v.pdf = select(mask, from.pdf, v.pdf);
  };
  const Mask lambertian = is_kind(m, BsdfKind::Lambertian);
  if (uses(scene, Feature::Lambertian) && any(lambertian)) {
    merge_value(lambertian, eval_lambertian(m.base_color, frame.z, wi));
  }
  const Mask fuzz = is_kind(m, BsdfKind::Fuzz);
  if (uses(scene, Feature::Fuzz) && any(fuzz)) {
    merge_value(fuzz, eval_fuzz(m.base_color, m.fuzz, frame.z, wo, wi));
  }
  const Mask ggx = is_kind(m, BsdfKind::Ggx);
  if (uses(scene, Feature::Ggx) && any(ggx)) {
    merge_value(ggx, eval_ggx(m.base_color, m.alpha, frame, wo, wi));
  }
  return v;
}

LIGHTBENCH_KERNEL_END
