#pragma once
// Texture lookup. A row of the texture table (kTextureStride numbers) is
//   0 kind, 1..3 colour a, 4..6 colour b, 7 scale, 8 use uv, 9 octaves, 10 seed, 11 wrap.

#include "core/kernel/scene_view.h"
#include "core/textures/image.h"
#include "core/textures/noise.h"

LIGHTBENCH_KERNEL_BEGIN

/// Values of TextureKind (core/scene/scene.h), as stored in the rows.
namespace texture_kind {
inline constexpr std::uint32_t kConstant = 0, kImage = 1, kChecker = 2, kNoise = 3, kTurbulence = 4,
                               kMarble = 5;
}

/// Value of texture i at uv and the object-space point p, in the active lanes.
inline Vec texture_value(const SceneView<T>& scene, std::uint32_t i, Real u, Real v, Vec p,
                         Mask active) {
  const T* numbers = scene.textures + std::size_t{i} * kTextureStride;
  const Row row{numbers};
  const Vec a = row.vec(1), b = row.vec(4);
  const Real scale = row[7];
  const Int seed(static_cast<std::uint32_t>(numbers[10]));
  switch (static_cast<std::uint32_t>(numbers[0])) {
    case texture_kind::kChecker: {
      const Vec q = (numbers[8] > T(0) ? Vec{u, v, Real(0)} : p) * scale;
      const Int parity = (to_int(floor(q.x)) + to_int(floor(q.y)) + to_int(floor(q.z))) & Int(1U);
      return select(parity == Int(1U), b, a);
    }
    case texture_kind::kNoise: {
      const Real w = fma(perlin_noise(p * scale, seed), Real(T(0.5)), Real(T(0.5)));
      return madd(b - a, clamp(w, Real(0), Real(1)), a);
    }
    case texture_kind::kTurbulence: {
      const Real w = turbulence(p * scale, static_cast<int>(numbers[9]), seed);
      return madd(b - a, min(w, Real(1)), a);
    }
    case texture_kind::kMarble: {
      // The books' marble: stripes along z whose phase the turbulence shifts.
      const Real w = turbulence(p, static_cast<int>(numbers[9]), seed);
      const Real stripes = fma(sin(fma(w, Real(10), scale * p.z)), Real(T(0.5)), Real(T(0.5)));
      return madd(b - a, stripes, a);
    }
    case texture_kind::kImage:
      return sample_image(scene.images[i], u, v, static_cast<std::uint32_t>(numbers[11]), active);
    default:
      return a;
  }
}

/// Each active lane's own texture; 1 elsewhere.
inline Vec eval_texture(const SceneView<T>& scene, Int index, Real u, Real v, Vec p, Mask active) {
  Vec value(Real(1));
  for_each_distinct(index, active, [&](std::uint32_t i, Mask m) {
    value = select(m, texture_value(scene, i, u, v, p, m), value);
  });
  return value;
}

LIGHTBENCH_KERNEL_END
