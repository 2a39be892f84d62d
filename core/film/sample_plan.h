#pragma once
// Adaptive sampling: how many samples each pixel gets, by how noisy its surroundings are.
//
// Counts grow in rounds that double the average. A round's counts are decided by all samples before
// it, and its own mean enters the picture with a weight that is fixed beforehand: its share of the
// average count, not of the pixel's. So whatever decides the counts, each round's mean is unbiased,
// and so is the picture (Kirk & Arvo 1991, "Unbiased Sampling Techniques for Image Synthesis", show
// the bias of weights by count: pixels that stop after lucky samples keep them). What it costs is
// small: the variance is that of a weighted harmonic mean of the rounds' instead of the best one.
//
// With fixed weights the least mean squared relative error has counts that follow the relative
// standard deviation of a sample in every round. It is smoothed over the neighbourhood, since the
// few samples of one pixel say little about it.

#include <cstdint>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/film/film.h"

namespace lightbench {

/// A pixel's samples in a round come in multiples of this: short aligned stretches of the Sobol
/// sequence are spread better than as many single samples.
inline constexpr std::uint32_t kChunk = 8;
/// Up to this average count all pixels have the same, enough to tell where the noise is; it is the
/// very picture that there is without adaptive sampling. A power of two.
inline constexpr std::uint32_t kUniformSpp = 16;
/// No pixel gets less than this share of a round's average, but for a chunk (and one chunk at
/// least)
/// ...
inline constexpr double kLeastShare = 0.1;
/// ... or more than this multiple of it.
inline constexpr double kMostShare = 16;

/// Least and most samples of any pixel.
struct SampleExtent {
  std::uint32_t least = 0, most = 0;
};

/// The counts of all pixels and the rounds before the present one, whose sums are in a film. All of
/// it is a function of the films at the ends of the rounds, and so of the scene alone: not of
/// threads or passes.
class SamplePlan {
 public:
  SamplePlan() = default;
  SamplePlan(int width, int height);

  /// False for a plan without pixels: sampling is not adaptive.
  [[nodiscard]] bool on() const { return width_ > 0; }

  /// Adds the round that `film` holds the sums of and plans the next, from an average of `spp`
  /// samples, a power of two from kUniformSpp on, to twice as many. The film is to be cleared then.
  void begin_round(std::uint32_t spp, const Film& film);
  /// The average count at which the present round begins; 0 up to kUniformSpp.
  [[nodiscard]] std::uint32_t round() const { return round_; }

  /// Samples of a pixel in the present round when the average over all rounds is `spp`: a multiple
  /// of kChunk that never falls as spp grows, or just spp in the first round. All pixels have their
  /// first chunk before any has its second.
  [[nodiscard]] std::uint32_t count(std::size_t pixel, std::uint32_t spp) const;

  /// Samples that take a pixel from one average count to another in the same round.
  [[nodiscard]] SampleRange range(std::size_t pixel, std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t first = count(pixel, from);
    return {before_[pixel] + first, count(pixel, to) - first};
  }

  /// Of all rounds.
  [[nodiscard]] SampleExtent extent(std::uint32_t spp) const;

  /// Writes the means of `count` pixels from pixel `begin` on, three floats each, when the average
  /// is `spp`, above 0; `sums` are theirs in the present round.
  void write_means(const FilmPixel* sums, std::size_t begin, std::size_t count, double unit,
                   std::uint32_t spp, float* rgb) const;

  /// `spp` times the variance of each pixel's mean luminance: what Film::variance() is when all
  /// pixels have the same count. The film holds the present round.
  [[nodiscard]] std::vector<float> variance(const Film& film, std::uint32_t spp) const;

  [[nodiscard]] std::uint64_t bytes() const;

 private:
  /// Weight of the rounds before the present one, in which the pixel has `count` samples.
  [[nodiscard]] double weight_of_past(std::uint32_t count, std::uint32_t spp) const;
  /// How many samples each pixel deserves, but for a factor.
  [[nodiscard]] std::vector<float> merit() const;

  int width_ = 0, height_ = 0;
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> before_;  // samples of each pixel in the rounds before
  std::vector<std::uint32_t> chunks_;  // that the present round adds
  std::vector<float> means_;           // of the rounds before, radiance, three a pixel
  std::vector<float> mean_variances_;  // of their luminance
  std::vector<float> variances_;       // of one sample's luminance
};

}  // namespace lightbench
