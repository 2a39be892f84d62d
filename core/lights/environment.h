#pragma once
// Radiance from outside the scene, by direction.

#include "core/kernel/scene_view.h"
#include "core/textures/image.h"

LIGHTBENCH_KERNEL_BEGIN

/// d is unit. Equirectangular images: the centre column looks along -z, the top row along +y.
inline Vec environment_radiance(const SceneView<T>& scene, Vec d, Mask active) {
  const EnvironmentView<T>& e = scene.environment;
  const Vec color{Real(e.color[0]), Real(e.color[1]), Real(e.color[2])};
  if (e.kind == 0) return color;
  if (e.kind == 1) {
    const Vec horizon{Real(e.horizon[0]), Real(e.horizon[1]), Real(e.horizon[2])};
    const Real w = fma(d.y, Real(T(0.5)), Real(T(0.5)));
    return madd(color - horizon, w, horizon);
  }
  const Vec q{fma(d.x, Real(e.cos_rotation), -(d.z * e.sin_rotation)), d.y,
              fma(d.x, Real(e.sin_rotation), d.z * e.cos_rotation)};
  const Real u = atan2(q.x, -q.z) * (kInvPi * T(0.5)) + Real(T(0.5));
  const Real v = acos(-q.y) * kInvPi;
  return sample_image(e.image, u, v, wrap_mode::kRepeat, active) * color;
}

LIGHTBENCH_KERNEL_END
