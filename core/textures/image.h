#pragma once
// Bilinear lookups in images, each lane's own place.

#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// Values of WrapMode (core/scene/scene.h), as stored in texture rows.
namespace wrap_mode {
inline constexpr std::uint32_t kRepeat = 0, kClamp = 1, kMirror = 2;
}

/// Column or row of the texels that lie at `i`, a whole number that is at most one off a period, on
/// an axis of n texels.
inline Real wrap_texel(Real i, Real n, std::uint32_t wrap) {
  if (wrap == wrap_mode::kClamp) return clamp(i, Real(0), n - Real(1));
  const Real period = wrap == wrap_mode::kMirror ? n + n : n;
  i = select(i < Real(0), i + period, i);
  i = select(i >= period, i - period, i);
  return select(i < n, i, period - Real(1) - i);
}

/// Component k of a texel.
inline T texel(const ImageView& image, std::uint32_t i, unsigned k) {
  return static_cast<T>(image.packed != nullptr ? image.values[image.packed[i] >> (8 * k) & 255U]
                                                : image.rgb[std::size_t{3} * i + k]);
}

/// u to the right, v up (the image's top row is v = 1). Texel centres lie at (i + 1/2) / n. Any u
/// and v will do: those that are not numbers count as 0. Black where !active.
[[gnu::noinline]] inline Vec sample_image(const ImageView& image, Real u, Real v,
                                          std::uint32_t wrap, Mask active) {
  // Beyond a million repeats the fraction has no precision left.
  const auto tame = [&](Real x) {
    x = clamp(select(x == x, x, Real(0)), Real(-T(1 << 20)), Real(T(1 << 20)));
    if (wrap == wrap_mode::kClamp) return x;
    const T period = wrap == wrap_mode::kMirror ? T(2) : T(1);
    return x - Real(period) * floor(x * (T(1) / period));
  };
  const Real width(static_cast<T>(image.width)), height(static_cast<T>(image.height));
  const Real x = tame(u) * width - Real(T(0.5));
  const Real y = (Real(1) - tame(v)) * height - Real(T(0.5));
  const Real left = floor(x), top = floor(y);
  const Real fx = x - left, fy = y - top;
  const Int width_in_texels(static_cast<std::uint32_t>(image.width));
  const Int columns[2] = {to_int(wrap_texel(left, width, wrap)),
                          to_int(wrap_texel(left + Real(1), width, wrap))};
  const Int rows[2] = {to_int(wrap_texel(top, height, wrap)) * width_in_texels,
                       to_int(wrap_texel(top + Real(1), height, wrap)) * width_in_texels};
  // One lane after the other: mostly few ask.
  alignas(64) std::uint32_t at[4][kLanes];
  alignas(64) T across[kLanes], down[kLanes], rgb[3][kLanes] = {};
  for (unsigned i = 0; i < 4; ++i) store(at[i], rows[i >> 1] + columns[i & 1]);
  store(across, fx);
  store(down, fy);
  for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const T x1 = across[lane], x0 = T(1) - x1, y1 = down[lane], y0 = T(1) - y1;
    for (unsigned k = 0; k < 3; ++k) {
      const T upper = texel(image, at[0][lane], k) * x0 + texel(image, at[1][lane], k) * x1;
      const T lower = texel(image, at[2][lane], k) * x0 + texel(image, at[3][lane], k) * x1;
      rgb[k][lane] = upper * y0 + lower * y1;
    }
  }
  return {load(rgb[0]), load(rgb[1]), load(rgb[2])};
}

LIGHTBENCH_KERNEL_END
