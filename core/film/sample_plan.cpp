#include "core/film/sample_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lightbench {
namespace {

/// Radius of the square neighbourhood whose noise is taken as the pixel's own, and of the one whose
/// mean is: noise needs many samples to be known, and means change at edges.
constexpr std::size_t kNoiseRadius = 3, kMeanRadius = 1;
/// Added to the squared mean, as a share of the picture's mean squared: noise counts less where it
/// is dark. (A share of 0.03 is 0.01, the usual floor of relMSE, in the scene with three lights.)
constexpr double kFloorShare = 0.03;
/// Added to each merit, so that a picture without noise is shared out evenly.
constexpr float kLeastMerit = 1e-6F;
/// Of a pixel in a round, so that sample indices fit 32 bits.
constexpr double kMostSamples = 1U << 30;

double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

/// Means over squares of 2 radius + 1 pixels, as far as they lie in the picture.
void smooth(std::vector<float>& values, int width, int height, std::size_t radius) {
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  const auto along = [radius](const std::vector<float>& in, std::vector<float>& out,
                              std::size_t lines, std::size_t line_step, std::size_t length,
                              std::size_t step) {
    for (std::size_t line = 0; line < lines; ++line) {
      const float* from = in.data() + line * line_step;
      float* to = out.data() + line * line_step;
      for (std::size_t i = 0; i < length; ++i) {
        const std::size_t first = i - std::min(i, radius);
        const std::size_t last = std::min(i + radius, length - 1);
        float sum = 0;
        for (std::size_t k = first; k <= last; ++k) sum += from[k * step];
        to[i * step] = sum / static_cast<float>(last - first + 1);
      }
    }
  };
  std::vector<float> rows(values.size());
  along(values, rows, h, w, w, 1);
  along(rows, values, w, 1, h, w);
}

/// Counts in proportion to merit, between a least and a most, whose average is `average`.
class Allocation {
 public:
  Allocation(const std::vector<float>& merit, double average)
      : merit_(merit),
        least_(std::max<double>(kChunk, kLeastShare * average)),
        most_(std::min(kMostShare * average, kMostSamples)) {
    // The sum is piecewise linear in the factor and rises with it: Newton's method, kept within a
    // bracket. It ends after some ten steps; more would mean that rounding is all that is left.
    constexpr int kMostSteps = 100;
    const double target = average * static_cast<double>(merit.size());
    double low = 0, high = std::numeric_limits<double>::infinity();
    for (int step = 0; step < kMostSteps; ++step) {
      double sum = 0, slope = 0;
      for (const float m : merit) {
        const double proportional = factor_ * static_cast<double>(m);
        const double count = std::clamp(proportional, least_, most_);
        sum += count;
        if (count == proportional) slope += static_cast<double>(m);
      }
      if (std::abs(sum - target) <= 1e-9 * target) return;
      (sum < target ? low : high) = factor_;
      double next = slope > 0 ? factor_ + (target - sum) / slope : 0;
      if (!(next > low && next < high)) next = std::isinf(high) ? 2 * low : 0.5 * (low + high);
      factor_ = next;
    }
  }

  double operator()(std::size_t i) const {
    return std::clamp(factor_ * static_cast<double>(merit_[i]), least_, most_);
  }

 private:
  const std::vector<float>& merit_;
  double least_, most_, factor_ = 1;
};

/// Whole chunks that sum up to `total`, one for each pixel at least: the running sum is rounded, so
/// that what one pixel gains the next ones lose.
void share_out(const Allocation& wanted, std::uint64_t total, std::vector<std::uint32_t>& chunks) {
  double sum = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) sum += wanted(i) - kChunk;
  const std::uint64_t shared = total - chunks.size();
  const double scale = sum > 0 ? static_cast<double>(shared) / sum : 0;
  double running = 0;
  std::uint64_t given = 0;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    running += wanted(i) - kChunk;
    const bool last = i + 1 == chunks.size();
    const auto due =
        last ? shared : std::min(shared, static_cast<std::uint64_t>(std::floor(running * scale)));
    chunks[i] = 1 + static_cast<std::uint32_t>(due - given);
    given = due;
  }
}

}  // namespace

SamplePlan::SamplePlan(int width, int height) : width_(width), height_(height) {
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  before_.assign(size, 0);
  chunks_.assign(size, 0);
  means_.assign(3 * size, 0);
  mean_variances_.assign(size, 0);
  variances_.assign(size, 0);
}

std::uint32_t SamplePlan::count(std::size_t pixel, std::uint32_t spp) const {
  if (round_ == 0) return spp;
  // What is due in part comes by turns: fractions in golden steps are spread evenly.
  const std::uint64_t turn = static_cast<std::uint32_t>(pixel) * 0x9e3779b9U;
  const std::uint64_t added = spp - round_;
  if (added <= kChunk)
    return added * (std::uint64_t{1} << 32) + turn * kChunk >= std::uint64_t{kChunk} << 32 ? kChunk
                                                                                           : 0;
  const std::uint64_t rest = round_ - kChunk;
  const std::uint64_t due =
      std::uint64_t{chunks_[pixel] - 1} * (added - kChunk) + ((turn * rest) >> 32);
  return kChunk * (1 + static_cast<std::uint32_t>(due / rest));
}

double SamplePlan::weight_of_past(std::uint32_t count, std::uint32_t spp) const {
  // A pixel that waits for its first chunk keeps its mean: whose turn it is has nothing to do with
  // what was seen. From the second chunk on all have one.
  return count == 0 ? 1 : static_cast<double>(round_) / std::max(spp, round_ + kChunk);
}

std::vector<float> SamplePlan::merit() const {
  std::vector<float> means(before_.size()), merit(before_.size());
  double sum = 0;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double mean = luminance(&means_[3 * i]);
    means[i] = static_cast<float>(mean);
    sum += mean;
  }
  const double mean = sum / static_cast<double>(means.size());
  // A black picture has no noise: the quotient is 0 then, not 0 / 0.
  const auto floor = static_cast<float>(std::max(1e-30, kFloorShare * mean * mean));
  smooth(means, width_, height_, kMeanRadius);
  for (std::size_t i = 0; i < merit.size(); ++i)
    merit[i] = variances_[i] / (means[i] * means[i] + floor);
  smooth(merit, width_, height_, kNoiseRadius);
  // The relative standard deviation to the power 3/4. Were it known, the power 1 would be best;
  // known from few samples it errs most where it is largest.
  for (float& value : merit) {
    const float deviation = std::sqrt(value);
    value = std::sqrt(deviation * std::sqrt(deviation)) + kLeastMerit;
  }
  return merit;
}

void SamplePlan::begin_round(std::uint32_t spp, const Film& film) {
  const double unit = film.unit();
  write_means(film.pixels().data(), 0, before_.size(), unit, spp, means_.data());
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const std::uint32_t n = count(i, spp);
    const double now = unit * unit * moments(film.pixels()[i], n).variance;
    const double past = round_ == 0 ? 0 : weight_of_past(n, spp);
    mean_variances_[i] = static_cast<float>(past * past * static_cast<double>(mean_variances_[i]) +
                                            (1 - past) * (1 - past) * now / n);
    // This one only decides counts, and may know as much as there is to know.
    variances_[i] = static_cast<float>((static_cast<double>(variances_[i]) * before_[i] + now * n) /
                                       (static_cast<double>(before_[i]) + n));
    before_[i] += n;
  }
  round_ = spp;
  share_out(Allocation(merit(), spp), std::uint64_t{spp} / kChunk * chunks_.size(), chunks_);
}

SampleExtent SamplePlan::extent(std::uint32_t spp) const {
  SampleExtent extent{UINT32_MAX, 0};
  for (std::size_t i = 0; i < before_.size(); ++i) {
    const std::uint32_t samples = before_[i] + count(i, spp);
    extent.least = std::min(extent.least, samples);
    extent.most = std::max(extent.most, samples);
  }
  return extent;
}

void SamplePlan::write_means(const FilmPixel* sums, std::size_t begin, std::size_t count,
                             double unit, std::uint32_t spp, float* rgb) const {
  if (round_ == 0) return lightbench::write_means(sums, count, unit, spp, rgb);
  const double step = unit / static_cast<double>(std::int64_t{1} << kFilmBits);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t n = this->count(begin + i, spp);
    const double past = weight_of_past(n, spp);
    const double scale = n == 0 ? 0 : (1 - past) * step / n;
    const auto mean = [&](float before, std::int64_t sum) {
      return static_cast<float>(past * static_cast<double>(before) +
                                scale * static_cast<double>(sum));
    };
    const float* before = &means_[3 * (begin + i)];
    const float values[3] = {mean(before[0], sums[i].r), mean(before[1], sums[i].g),
                             mean(before[2], sums[i].b)};
    std::copy(values, values + 3, rgb + 3 * i);  // which may be `before` itself
  }
}

std::vector<float> SamplePlan::variance(const Film& film, std::uint32_t spp) const {
  if (round_ == 0) return film.variance(spp);
  std::vector<float> variance(before_.size());
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const std::uint32_t n = count(i, spp);
    const double past = weight_of_past(n, spp);
    double of_mean = past * past * static_cast<double>(mean_variances_[i]);
    if (n > 0) {
      of_mean += (1 - past) * (1 - past) * film.unit() * film.unit() *
                 moments(film.pixels()[i], n).variance / n;
    }
    variance[i] = static_cast<float>(spp * of_mean);
  }
  return variance;
}

std::uint64_t SamplePlan::bytes() const {
  return (before_.size() + chunks_.size()) * sizeof(std::uint32_t) +
         (means_.size() + mean_variances_.size() + variances_.size()) * sizeof(float);
}

}  // namespace lightbench
