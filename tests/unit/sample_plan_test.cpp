#include "core/film/sample_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace lightbench {
namespace {

constexpr double kStep = 1.0 / (std::int64_t{1} << kFilmBits);
constexpr double kSquareStep = 1.0 / (std::int64_t{1} << kFilmSquareBits);

/// A grey picture whose samples are drawn by `sample(pixel, random)`, as many as its plan wants.
template <class Sample>
class Drawn {
 public:
  Drawn(int width, int height, std::uint32_t seed, Sample sample)
      : plan(width, height),
        film(width, height, 1),
        sums(film.pixels().size()),
        counts(film.pixels().size()),
        sample_(sample),
        random_(seed) {}

  /// To an average of `spp` samples, which lies in the round at hand or the next.
  void draw(std::uint32_t spp) {
    if (spp > at && at >= kUniformSpp && (at & (at - 1)) == 0) {
      plan.begin_round(at, film);
      film.clear();
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const SampleRange range = plan.range(i, at, spp);
      EXPECT_EQ(range.first, counts[i]);  // each index once, none left out
      for (std::uint32_t k = 0; k < range.count; ++k) add(i, sample_(i, random_));
      counts[i] += range.count;
    }
    at = spp;
  }
  /// Through all rounds up to `spp`, a power of two.
  void draw_rounds(std::uint32_t spp) {
    for (std::uint32_t end = kUniformSpp; end <= spp; end *= 2) draw(end);
  }
  [[nodiscard]] std::vector<float> picture() const {
    std::vector<float> rgb(3 * counts.size());
    plan.write_means(film.pixels().data(), 0, counts.size(), 1, at, rgb.data());
    std::vector<float> grey;
    for (std::size_t i = 0; i < rgb.size(); i += 3) grey.push_back(rgb[i]);
    return grey;
  }
  /// The picture in which every sample has the same weight.
  [[nodiscard]] std::vector<float> picture_by_counts() const {
    std::vector<float> grey;
    for (std::size_t i = 0; i < counts.size(); ++i)
      grey.push_back(static_cast<float>(sums[i] / counts[i]));
    return grey;
  }

  SamplePlan plan;
  Film film;
  std::vector<double> sums;
  std::vector<std::uint32_t> counts;
  std::uint32_t at = 0;

 private:
  void add(std::size_t i, double value) {
    FilmPixel& pixel = film.view().pixels[i];
    const std::int64_t steps = std::llround(value / kStep);
    pixel.r += steps;
    pixel.g += steps;
    pixel.b += steps;
    pixel.luminance_squared += std::llround(value * value / kSquareStep);
    sums[i] += value;
  }

  Sample sample_;
  std::mt19937 random_;
};

double exponential(std::mt19937& random) { return std::exponential_distribution<>(1)(random); }

TEST(SamplePlan, CountsKeepToTheBudgetTheFloorAndTheCap) {
  constexpr std::size_t kPixels = 61 * 40;
  // One pixel in ten is a thousand times noisier than the rest.
  Drawn picture(61, 40, 1, [](std::size_t i, std::mt19937& random) {
    return 1 + (i % 397 == 0 ? 100 : 1e-3) * exponential(random);
  });
  std::vector<std::uint32_t> before(kPixels);
  std::uint32_t most = 0;
  for (std::uint32_t spp = kUniformSpp; spp <= 512; spp *= 2) {
    picture.draw(spp);
    const std::uint32_t average = spp == kUniformSpp ? spp : spp / 2;
    for (std::size_t i = 0; i < kPixels; ++i) {
      const std::uint32_t added = picture.counts[i] - before[i];
      EXPECT_GE(added, kChunk);
      EXPECT_GE(added + kChunk, kLeastShare * average);
      EXPECT_LE(added, kMostShare * average + kChunk);
      most = std::max(most, added);
    }
    before = picture.counts;
    EXPECT_EQ(std::accumulate(before.begin(), before.end(), std::uint64_t{0}), spp * kPixels);
    const SampleExtent extent = picture.plan.extent(spp);
    EXPECT_EQ(extent.least, *std::min_element(before.begin(), before.end()));
    EXPECT_EQ(extent.most, *std::max_element(before.begin(), before.end()));
  }
  EXPECT_GT(most, 1000U);
}

TEST(SamplePlan, RoundsMayBeCutAnywhere) {
  const auto sample = [](std::size_t i, std::mt19937& random) {
    return static_cast<double>(i % 5) * exponential(random);
  };
  Drawn whole(37, 23, 2, sample), cut(37, 23, 2, sample);
  whole.draw_rounds(64);
  cut.draw_rounds(64);
  whole.draw(128);
  for (const std::uint32_t spp : {65U, 66U, 71U, 72U, 73U, 100U, 127U, 128U}) {
    cut.draw(spp);
    const double sum = std::accumulate(cut.counts.begin(), cut.counts.end(), 0.0);
    EXPECT_NEAR(sum / (37 * 23), spp, 0.05) << spp;
    const std::vector<float> picture = cut.picture();
    for (std::size_t i = 0; i < picture.size(); ++i) {
      EXPECT_TRUE(std::isfinite(picture[i]));
      if (i % 5 == 0) {
        EXPECT_EQ(picture[i], 0.0F);
      }
    }
  }
  EXPECT_EQ(cut.counts, whole.counts);
}

TEST(SamplePlan, SamplesFollowTheRelativeDeviation) {
  // From left to right: no noise, noise, the same noise of a ten times brighter picture.
  Drawn picture(120, 40, 3, [](std::size_t i, std::mt19937& random) {
    const std::size_t x = i % 120;
    return (x < 80 ? 1 : 10) + (x < 40 ? 0 : 1) * (exponential(random) - 0.5);
  });
  picture.draw_rounds(512);
  const auto mean_count = [&](std::size_t x0, std::size_t x1) {
    double sum = 0;
    for (std::size_t y = 0; y < 40; ++y)
      for (std::size_t x = x0; x < x1; ++x) sum += picture.counts[120 * y + x];
    return sum / static_cast<double>(40 * (x1 - x0));
  };
  EXPECT_LT(mean_count(4, 36), 100);
  EXPECT_GT(mean_count(44, 76), 2 * mean_count(84, 116));
  EXPECT_GT(mean_count(44, 76), 700);
}

TEST(SamplePlan, WithoutNoiseAllPixelsAreAlike) {
  for (const double value : {0.0, 0.5}) {
    Drawn picture(20, 10, 1, [value](std::size_t, std::mt19937&) { return value; });
    picture.draw_rounds(256);
    const SampleExtent extent = picture.plan.extent(256);
    EXPECT_GE(extent.least, 224U) << value;
    EXPECT_LE(extent.most, 288U) << value;
    for (const float mean : picture.picture()) EXPECT_EQ(mean, static_cast<float>(value));
  }
}

TEST(SamplePlan, PictureIsThePlainOneUpToTheFirstRound) {
  Drawn picture(9, 4, 3, [](std::size_t, std::mt19937& random) { return exponential(random); });
  for (const std::uint32_t spp : {1U, 3U, 8U, 16U}) {
    picture.draw(spp);
    const Image plain = picture.film.mean(spp);
    for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(picture.picture()[i], plain.rgb[3 * i]);
    EXPECT_EQ(picture.plan.variance(picture.film, spp), picture.film.variance(spp));
  }
}

TEST(SamplePlan, VarianceTellsTheErrorOfThePicture) {
  Drawn picture(100, 100, 4, [](std::size_t i, std::mt19937& random) {
    return i / 100 < 50 ? 1 + 8 * exponential(random) : 9.0;
  });
  picture.draw_rounds(128);
  for (const std::uint32_t spp : {128U, 132U, 200U, 256U}) {
    picture.draw(spp);
    const std::vector<float> variances = picture.plan.variance(picture.film, spp);
    const std::vector<float> means = picture.picture();
    double told = 0, seen = 0;
    for (std::size_t i = 0; i < variances.size(); ++i) {
      told += static_cast<double>(variances[i]) / spp;
      seen += std::pow(static_cast<double>(means[i]) - 9, 2);
    }
    // 5000 noisy pixels: four standard errors of their squares' sum.
    EXPECT_NEAR(seen / told, 1, 0.08) << spp;
  }
}

// Rare bright samples: pixels that stop because none came stay too dark, if their samples have
// weights by count. The same test must see that.
TEST(SamplePlan, CountsDoNotBiasThePicture) {
  constexpr std::uint32_t kSeeds = 64;
  for (const std::uint32_t spp : {32U, 40U, 64U}) {
    std::vector<double> means, by_counts;
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
      Drawn picture(64, 64, seed, [](std::size_t, std::mt19937& random) {
        return std::uniform_real_distribution<>(0, 1)(random) < 1 / 1000.0 ? 1000.0 : 0.0;
      });
      for (std::uint32_t end = kUniformSpp; picture.at < spp; end *= 2) {
        picture.draw(std::min(end, spp));
      }
      const auto mean = [](const std::vector<float>& grey) {
        return std::accumulate(grey.begin(), grey.end(), 0.0) / static_cast<double>(grey.size());
      };
      means.push_back(mean(picture.picture()));
      by_counts.push_back(mean(picture.picture_by_counts()));
    }
    const auto deviation = [](const std::vector<double>& values) {
      const double mean = std::accumulate(values.begin(), values.end(), 0.0) / kSeeds;
      double squares = 0;
      for (const double v : values) squares += (v - mean) * (v - mean);
      return (mean - 1) / std::sqrt(squares / (kSeeds * (kSeeds - 1)));
    };
    EXPECT_LT(std::abs(deviation(means)), 3) << spp;
    EXPECT_LT(deviation(by_counts), -4) << spp;
  }
}

}  // namespace
}  // namespace lightbench
