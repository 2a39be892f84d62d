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

/// A sample's share of the film: red, green, blue and squared luminance.
typedef double FilmShare __attribute__((vector_size(32)));
typedef std::int64_t FilmSteps __attribute__((vector_size(32)));
typedef std::uint64_t FilmSums __attribute__((vector_size(32)));
static_assert(sizeof(FilmPixel) == sizeof(FilmSums));

/// Adds the finished paths of `done` to the film. A sample that is not finite or beyond the film's
/// range is dropped and counted, by its fault, with the place of the first.
inline void splat(const SceneView<T>& scene, const Paths& paths, Mask done, const Work& work,
                  FilmView film, Counters& counters) {
  alignas(64) T rgb[3][kLanes], luminances[kLanes];
  alignas(64) std::uint32_t pixels[kLanes], dither[kLanes];
  const Vec value = paths.radiance * Real(scene.inverse_film_unit);
  store(rgb[0], value.x);
  store(rgb[1], value.y);
  store(rgb[2], value.z);
  store(luminances, luminance(value));
  store(pixels, paths.pixel);
  // Rounding up or down by chance, with a number of the sample's own, keeps means unbiased however
  // far they lie below the film's step.
  store(dither, hash(paths.sampler.pixel_key, paths.sample));
  const auto accepted = [](Real x) {
    return x >= Real(0) && x <= Real(static_cast<T>(kFilmSampleLimit));
  };
  const Mask kept = done && accepted(value.x) && accepted(value.y) && accepted(value.z);
  constexpr auto kStep = static_cast<double>(std::int64_t{1} << kFilmBits);
  constexpr auto kSquareStep = static_cast<double>(std::int64_t{1} << kFilmSquareBits);
  counters.paths += static_cast<std::uint64_t>(__builtin_popcount(bits(done)));
  for (std::uint32_t m = bits(kept); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const auto y = static_cast<double>(luminances[lane]);
    const FilmShare share = {static_cast<double>(rgb[0][lane]), static_cast<double>(rgb[1][lane]),
                             static_cast<double>(rgb[2][lane]), y};
    const FilmShare unit = {kStep, kStep, kStep, y * kSquareStep};
    const FilmSteps steps =
        __builtin_convertvector(share * unit + dither[lane] * 0x1p-32, FilmSteps);
    FilmPixel& pixel = film.pixels[pixels[lane]];
    FilmSums sums;
    __builtin_memcpy(&sums, &pixel, sizeof sums);
    sums += FilmSums(steps);
    __builtin_memcpy(static_cast<void*>(&pixel), &sums, sizeof sums);
    // Saturating, which for sums of non-negative numbers does not depend on their order either.
    if (pixel.luminance_squared < 0) pixel.luminance_squared = INT64_MAX;
  }
  if (none(done && !kept)) return;
  alignas(64) std::uint32_t samples[kLanes];
  store(samples, paths.sample);
  for (std::uint32_t m = bits(done && !kept); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const auto width = static_cast<std::uint32_t>(film.width);
    counters.drop(
        {static_cast<int>(pixels[lane] % width) * work.stride + scene.camera.crop_x,
         static_cast<int>(pixels[lane] / width) * work.stride + scene.camera.crop_y, samples[lane]},
        fault_of(rgb[0][lane], rgb[1][lane], rgb[2][lane]));
  }
}

LIGHTBENCH_KERNEL_END
