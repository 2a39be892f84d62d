#pragma once
// The accumulation buffer. Sums are 64-bit fixed point, so they do not depend on the order of
// lanes, tiles or threads: the same samples give the same bits. 32 bytes per pixel.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/film/frame.h"

namespace lightbench {

/// Sums over samples of red, green, blue and squared luminance, each a multiple of its film unit.
struct FilmPixel {
  std::int64_t r = 0, g = 0, b = 0, luminance_squared = 0;
};

/// One radiance unit of the film is 2^kFilmBits steps. compile() picks `unit` (radiance, a power of
/// two, near the brightest emission) so that the step is 2^-30 of it: at 1e6 spp a pixel may
/// average 8000 units before the sum could overflow. Samples are rounded to a step by chance (with
/// a hash of the sample), so means are unbiased far below it. A sample is accepted up to
/// kFilmSampleLimit units.
inline constexpr int kFilmBits = 30;
inline constexpr int kFilmSquareBits = 24;
inline constexpr float kFilmSampleLimit = 524288.0F;  // 2^19: 2^49 steps, and 2^62 squared steps

/// What a kernel writes to; pixel (x, y) of the film is pixels[y * width + x].
struct FilmView {
  FilmPixel* pixels = nullptr;
  int width = 0;
};

/// Writes the means over `spp` samples (above 0) of `count` pixels of a film of `unit` to `rgb`,
/// three floats each.
void write_means(const FilmPixel* pixels, std::size_t count, double unit, std::uint32_t spp,
                 float* rgb);

/// Mean and unbiased variance (of one sample) of a pixel's luminance over `count` samples, at least
/// 2, in film units; the variance is never negative.
struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const FilmPixel& sum, double count);

/// Not thread-safe as a whole; different pixels may be written by different threads.
class Film {
 public:
  Film() = default;
  /// Throws Error{Usage} if the size is not positive or too large to hold.
  Film(int width, int height, double unit);
  void clear();
  [[nodiscard]] FilmView view() { return {pixels_.data(), width_}; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] double unit() const { return unit_; }
  [[nodiscard]] const std::vector<FilmPixel>& pixels() const { return pixels_; }
  /// Means over `spp` samples.
  [[nodiscard]] Image mean(std::uint32_t spp) const;
  /// Sample variance of luminance per pixel; 0 for fewer than 2 samples.
  [[nodiscard]] std::vector<float> variance(std::uint32_t spp) const;
  /// FNV-1a over the raw sums: equal films, equal hashes.
  [[nodiscard]] std::uint64_t hash() const;

 private:
  int width_ = 0;
  int height_ = 0;
  double unit_ = 1;
  std::vector<FilmPixel> pixels_;
};

}  // namespace lightbench
