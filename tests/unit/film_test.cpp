#include "core/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"

namespace lightbench {
namespace {

constexpr double kStep = 1.0 / (std::int64_t{1} << kFilmBits);
constexpr double kSquareStep = 1.0 / (std::int64_t{1} << kFilmSquareBits);

/// As a kernel adds a sample: rounded to steps of the film's unit.
void add(FilmPixel& pixel, double r, double g, double b, double unit) {
  const double y = (0.2126 * r + 0.7152 * g + 0.0722 * b) / unit;
  pixel.r += std::llround(r / unit / kStep);
  pixel.g += std::llround(g / unit / kStep);
  pixel.b += std::llround(b / unit / kStep);
  pixel.luminance_squared += std::llround(y * y / kSquareStep);
}

TEST(Film, MeanIsTheMeanOfTheSamples) {
  Film film(2, 1, 8.0);
  const FilmView view = film.view();
  add(view.pixels[1], 1.0, 2.0, 3.0, 8.0);
  add(view.pixels[1], 3.0, 0.0, 0.5, 8.0);
  const Image image = film.mean(2);
  ASSERT_EQ(image.rgb.size(), 6U);
  EXPECT_EQ(image.rgb[0], 0.0F);
  EXPECT_FLOAT_EQ(image.rgb[3], 2.0F);
  EXPECT_FLOAT_EQ(image.rgb[4], 1.0F);
  EXPECT_FLOAT_EQ(image.rgb[5], 1.75F);
}

TEST(Film, VarianceIsTheUnbiasedVarianceOfLuminance) {
  std::mt19937 engine(7);
  std::exponential_distribution<double> radiance(0.5);
  const double unit = 4.0;
  Film film(1, 1, unit);
  const int n = 1000;
  double sum = 0, square = 0;
  for (int i = 0; i < n; ++i) {
    const double r = radiance(engine), g = radiance(engine), b = radiance(engine);
    add(film.view().pixels[0], r, g, b, unit);
    const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    sum += y;
    square += y * y;
  }
  const std::vector<float> variance = film.variance(n);
  ASSERT_EQ(variance.size(), 1U);
  const double expected = (square - sum * sum / n) / (n - 1);
  EXPECT_NEAR(variance[0], expected, 1e-5 * expected);
}

TEST(Film, VarianceOfEqualSamplesIsZeroAndNeverNegative) {
  Film film(1, 1, 1.0);
  for (int i = 0; i < 1000; ++i) add(film.view().pixels[0], 0.7, 0.1, 0.3, 1.0);
  const std::vector<float> variance = film.variance(1000);
  EXPECT_GE(variance[0], 0.0F);
  EXPECT_NEAR(variance[0], 0.0F, 1e-6F);
  EXPECT_EQ(film.variance(1)[0], 0.0F);
}

TEST(Film, StaysAccurateAtAMillionSamples) {
  // A float sum stops growing at 2^24 times its addend: 0.1 a million times is 1 % off.
  const double unit = 16.0;
  const double value = 0.1;
  Film film(1, 1, unit);
  FilmPixel& pixel = film.view().pixels[0];
  add(pixel, value, value, value, unit);
  pixel.r *= 1'000'000;
  EXPECT_NEAR(film.mean(1'000'000).rgb[0], value, 2e-8);
  // The brightest pixel the header promises: 8000 units on average.
  pixel.r = std::int64_t{8000} * 1'000'000 * (std::int64_t{1} << kFilmBits);
  EXPECT_GT(pixel.r, 0);
  EXPECT_FLOAT_EQ(film.mean(1'000'000).rgb[0], static_cast<float>(8000 * unit));
}

TEST(Film, HashTellsSumsApartAndClearForgets) {
  Film a(3, 2, 1.0), b(3, 2, 1.0);
  EXPECT_EQ(a.hash(), b.hash());
  add(a.view().pixels[4], 1, 1, 1, 1.0);
  EXPECT_NE(a.hash(), b.hash());
  add(b.view().pixels[5], 1, 1, 1, 1.0);
  EXPECT_NE(a.hash(), b.hash()) << "the same sums at another pixel";
  a.clear();
  b.clear();
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_EQ(a.mean(1).rgb[12], 0.0F);
}

TEST(Film, RejectsSizesItCannotHold) {
  for (const auto& [width, height] : {std::pair{0, 5}, {5, -1}, {100000, 100000}}) {
    try {
      Film film(width, height, 1.0);
      FAIL() << width << "x" << height;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Usage);
      EXPECT_NE(std::string(error.what()).find("resolution"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace lightbench
