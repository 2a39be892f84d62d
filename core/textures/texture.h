#pragma once
// Texture lookup. A row of the texture table (kTextureStride numbers) is
//   0 kind, 1..3 colour a, 4..6 colour b, 7 scale, 8 use uv, 9 octaves, 10 seed, 11 wrap.

#include "core/kernel/scene_view.h"
#include "core/textures/noise.h"

LIGHTBENCH_KERNEL_BEGIN

/// Values of TextureKind and WrapMode (core/scene/scene.h), as stored in the rows.
namespace texture_kind {
inline constexpr std::uint32_t kConstant = 0, kImage = 1, kChecker = 2, kNoise = 3, kTurbulence = 4,
                               kMarble = 5;
}

/// Texel coordinate of `i` (any integer) on an axis of n texels.
inline int wrap_texel(int i, int n, std::uint32_t wrap) {
  if (wrap == 1) return i < 0 ? 0 : (i >= n ? n - 1 : i);
  const int period = wrap == 2 ? 2 * n : n;
  i %= period;
  if (i < 0) i += period;
  return i < n ? i : period - 1 - i;
}

/// Bilinear; u to the right, v up (the image's top row is v = 1). Texel centres lie at (i + 1/2) /
/// n.
inline void sample_image(const ImageView& image, T u, T v, std::uint32_t wrap, T* rgb) {
  // Beyond a million repeats the fraction has no precision left; keeps the integers in range too.
  const T limit = T(1 << 20);
  u = u < -limit ? -limit : (u > limit ? limit : (u == u ? u : T(0)));
  v = v < -limit ? -limit : (v > limit ? limit : (v == v ? v : T(0)));
  if (wrap != 1) {
    const T period = wrap == 2 ? T(2) : T(1);
    u -= period * static_cast<T>(__builtin_floor(u / period));
    v -= period * static_cast<T>(__builtin_floor(v / period));
  }
  const T x = u * static_cast<T>(image.width) - T(0.5);
  const T y = (T(1) - v) * static_cast<T>(image.height) - T(0.5);
  const T fx0 = static_cast<T>(__builtin_floor(x)), fy0 = static_cast<T>(__builtin_floor(y));
  const T fx = x - fx0, fy = y - fy0;
  const T edge = T(1 << 30);
  const int ix = static_cast<int>(fx0 < -edge ? -edge : (fx0 > edge ? edge : fx0));
  const int iy = static_cast<int>(fy0 < -edge ? -edge : (fy0 > edge ? edge : fy0));
  const int xs[2] = {wrap_texel(ix, image.width, wrap), wrap_texel(ix + 1, image.width, wrap)};
  const int ys[2] = {wrap_texel(iy, image.height, wrap), wrap_texel(iy + 1, image.height, wrap)};
  const auto texel = [&](int i, int j) {
    return image.rgb + std::size_t{3} * (static_cast<std::size_t>(ys[j]) *
                                             static_cast<std::size_t>(image.width) +
                                         static_cast<std::size_t>(xs[i]));
  };
  for (int k = 0; k < 3; ++k) {
    const T top =
        static_cast<T>(texel(0, 0)[k]) * (T(1) - fx) + static_cast<T>(texel(1, 0)[k]) * fx;
    const T bottom =
        static_cast<T>(texel(0, 1)[k]) * (T(1) - fx) + static_cast<T>(texel(1, 1)[k]) * fx;
    rgb[k] = top * (T(1) - fy) + bottom * fy;
  }
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
    case texture_kind::kImage: {
      alignas(64) T us[kLanes], vs[kLanes], rgb[3][kLanes] = {};
      store(us, u);
      store(vs, v);
      const auto wrap = static_cast<std::uint32_t>(numbers[11]);
      for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(m));
        T texel[3];
        sample_image(scene.images[i], us[lane], vs[lane], wrap, texel);
        for (unsigned k = 0; k < 3; ++k) rgb[k][lane] = texel[k];
      }
      return {load(rgb[0]), load(rgb[1]), load(rgb[2])};
    }
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
