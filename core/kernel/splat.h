#pragma once
// Where paths end: their radiance goes to the film.

#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/kernel/paths.h"

LIGHTBENCH_KERNEL_BEGIN

/// What keeps a colour from the film.
inline Fault fault_of(T r, T g, T b) {
  if (r != r || g != g || b != b) return Fault::NotANumber;
  const auto infinite = [](T x) { return x - x != T(0); };
  if (infinite(r) || infinite(g) || infinite(b)) return Fault::Infinite;
  return r < T(0) || g < T(0) || b < T(0) ? Fault::Negative : Fault::BeyondFilm;
}

/// Adds the finished paths of `done` to the film. A sample that is not finite or beyond the film's
/// range is dropped and counted, by its fault, with the place
/// of the first.
inline void splat(const SceneView<T>& scene, const Paths& paths, Mask done, const Work& work,
                  FilmView film, Counters& counters) {
  alignas(64) T rgb[3][kLanes], luminances[kLanes];
  alignas(64) std::uint32_t pixels[kLanes], samples[kLanes], dither[kLanes];
  const Vec value = paths.radiance * Real(scene.inverse_film_unit);
  store(rgb[0], value.x);
  store(rgb[1], value.y);
  store(rgb[2], value.z);
  store(luminances, luminance(value));
  store(pixels, paths.pixel);
  store(samples, paths.sample);
  // Rounding up or down by chance, with a number of the sample's own, keeps means unbiased however
  // far they lie below the film's step.
  store(dither, hash(paths.sampler.pixel_key, paths.sample));
  constexpr auto kLimit = static_cast<T>(kFilmSampleLimit);
  constexpr auto kStep = static_cast<double>(std::int64_t{1} << kFilmBits);
  constexpr auto kSquareStep = static_cast<double>(std::int64_t{1} << kFilmSquareBits);
  for (std::uint32_t m = bits(done); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    ++counters.paths;
    const T r = rgb[0][lane], g = rgb[1][lane], b = rgb[2][lane];
    if (!(r >= T(0) && g >= T(0) && b >= T(0) && r <= kLimit && g <= kLimit && b <= kLimit)) {
      const auto width = static_cast<std::uint32_t>(film.width);
      counters.drop({static_cast<int>(pixels[lane] % width) * work.stride + scene.camera.crop_x,
                     static_cast<int>(pixels[lane] / width) * work.stride + scene.camera.crop_y,
                     samples[lane]},
                    fault_of(r, g, b));
      continue;
    }
    FilmPixel& pixel = film.pixels[pixels[lane]];
    const double chance = dither[lane] * 0x1p-32;
    const auto steps = [chance](double x) { return static_cast<std::int64_t>(x + chance); };
    pixel.r += steps(static_cast<double>(r) * kStep);
    pixel.g += steps(static_cast<double>(g) * kStep);
    pixel.b += steps(static_cast<double>(b) * kStep);
    const auto y = static_cast<double>(luminances[lane]);
    const std::int64_t squared = steps(y * y * kSquareStep);
    // Saturating, which for sums of non-negative numbers does not depend on their order either.
    if (__builtin_add_overflow(pixel.luminance_squared, squared, &pixel.luminance_squared)) {
      pixel.luminance_squared = INT64_MAX;
    }
  }
}

LIGHTBENCH_KERNEL_END
