#include "core/film/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lightbench {
namespace {

constexpr ToneMap kOperators[] = {ToneMap::Srgb, ToneMap::Reinhard, ToneMap::Aces};

float grey(float radiance, const Display& display) {
  return display_value({radiance, radiance, radiance}, display)[1];
}

TEST(ToneMap, SrgbCurveHasItsKnownValues) {
  EXPECT_EQ(srgb_from_linear(0), 0);
  EXPECT_NEAR(srgb_from_linear(1), 1, 1e-6);
  EXPECT_NEAR(srgb_from_linear(0.5F), 0.735357F, 1e-5);
  EXPECT_NEAR(srgb_from_linear(0.0031308F), 0.04045F, 1e-5);
  EXPECT_NEAR(linear_from_srgb(0.5F), 0.214041F, 1e-5);
}

TEST(ToneMap, EveryByteSurvivesDecodingAndEncoding) {
  for (int byte = 0; byte < 256; ++byte) {
    const float linear = linear_from_srgb(static_cast<float>(byte) / 255);
    const Image image{1, 1, {linear, linear, linear}};
    EXPECT_EQ(to_8_bit(image, {})[0], byte);
  }
}

TEST(ToneMap, ExposureIsInStops) {
  const Display plus_two{2, ToneMap::Srgb};
  EXPECT_FLOAT_EQ(grey(0.1F, plus_two), srgb_from_linear(0.4F));
  const Display minus_one{-1, ToneMap::Srgb};
  EXPECT_FLOAT_EQ(grey(0.1F, minus_one), srgb_from_linear(0.05F));
}

TEST(ToneMap, OperatorsHaveTheirKnownValues) {
  EXPECT_FLOAT_EQ(grey(3, {0, ToneMap::Srgb}), 1);
  EXPECT_FLOAT_EQ(grey(1, {0, ToneMap::Reinhard}), srgb_from_linear(0.5F));
  EXPECT_FLOAT_EQ(grey(3, {0, ToneMap::Reinhard}), srgb_from_linear(0.75F));
  EXPECT_NEAR(grey(1, {0, ToneMap::Aces}), srgb_from_linear(2.54F / 3.16F), 1e-6);
}

TEST(ToneMap, OperatorsRiseFromBlackToWhite) {
  for (const ToneMap tone_map : kOperators) {
    const Display display{0, tone_map};
    EXPECT_EQ(grey(0, display), 0);
    float last = 0;
    for (double stop = -20; stop <= 20; stop += 0.01) {
      const float value = grey(static_cast<float>(std::exp2(stop)), display);
      EXPECT_GE(value, last) << "at " << stop << " stops";
      EXPECT_LE(value, 1);
      last = value;
    }
    EXPECT_GT(last, 0.999F);
  }
}

TEST(ToneMap, NothingIsOutsideTheRange) {
  const float odd[] = {-1,
                       -std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN(),
                       3e38F,
                       1e-45F};
  for (const ToneMap tone_map : kOperators) {
    for (const double exposure : {-100.0, 0.0, 100.0}) {
      for (const float radiance : odd) {
        const float value = grey(radiance, {exposure, tone_map});
        EXPECT_GE(value, 0);
        EXPECT_LE(value, 1);
      }
    }
  }
  EXPECT_EQ(grey(std::numeric_limits<float>::quiet_NaN(), {}), 0);
  EXPECT_FLOAT_EQ(grey(std::numeric_limits<float>::infinity(), {}), 1);
}

TEST(ToneMap, BytesAreRoundedToNearestInOrder) {
  const Image image{
      2, 1, {0, linear_from_srgb(100.4F / 255), linear_from_srgb(100.6F / 255), 1, 2, 0}};
  EXPECT_EQ(to_8_bit(image, {}), (std::vector<std::uint8_t>{0, 100, 101, 255, 255, 0}));
}

}  // namespace
}  // namespace lightbench
