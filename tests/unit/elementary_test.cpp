// The float kernels' elementary functions against the C library in double, over the ranges that
// core/kernel/elementary_float.h states.

#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// Distance in units of the spacing of floats at `exact`.
double ulps(float value, double exact) {
  const auto f = static_cast<float>(exact);
  const double spacing =
      static_cast<double>(std::nextafter(std::abs(f), std::numeric_limits<float>::infinity())) -
      static_cast<double>(std::abs(f));
  return std::abs(static_cast<double>(value) - exact) / spacing;
}

constexpr int kPoints = 400000;

TEST(Elementary, ExponentialFunction) {
  double worst = 0;
  for (int i = 0; i <= kPoints; ++i) {
    const auto x = static_cast<float>(-87.3 + i * (175.3 / kPoints));
    worst = std::max(worst, ulps(exp(x), std::exp(static_cast<double>(x))));
  }
  EXPECT_LT(worst, 2);
  EXPECT_EQ(exp(0.0F), 1.0F);
  // Clamped beyond, never infinite and never negative.
  EXPECT_EQ(exp(1e9F), exp(88.0F));
  EXPECT_EQ(exp(-1e9F), exp(-87.3F));
  EXPECT_TRUE(std::isfinite(exp(std::numeric_limits<float>::infinity())));
  EXPECT_GE(exp(-std::numeric_limits<float>::infinity()), 0.0F);
}

TEST(Elementary, Logarithm) {
  double worst = 0;
  std::mt19937 engine(1);
  for (int i = 0; i < kPoints; ++i) {
    // Any normal positive number, and densely around 1.
    const auto any = static_cast<std::uint32_t>(0x00800000U + engine() % 0x7effffffU);
    float x;
    std::memcpy(&x, &any, sizeof x);
    worst = std::max(worst, ulps(log(x), std::log(static_cast<double>(x))));
    const float near = 1 + 0.9F * (static_cast<float>(i) / kPoints - 0.5F);
    if (near != 1.0F) worst = std::max(worst, ulps(log(near), std::log(static_cast<double>(near))));
  }
  EXPECT_LT(worst, 4);
  EXPECT_EQ(log(1.0F), 0.0F);
}

TEST(Elementary, FreeFlight) {
  double worst = 0;
  for (std::uint32_t i = 1; i < 1U << 24; i += 41) {
    const float u = static_cast<float>(i) * 0x1p-24F;
    worst = std::max(worst, ulps(exponential(u), -std::log1p(-static_cast<double>(u))));
  }
  EXPECT_LT(worst, 4);
  EXPECT_EQ(exponential(0.0F), 0.0F);
  EXPECT_NEAR(static_cast<double>(exponential(1 - 0x1p-24F)), 24 * std::numbers::ln2, 1e-5);
}

TEST(Elementary, SineAndCosine) {
  double worst_near = 0, worst = 0;
  for (int i = 0; i <= kPoints; ++i) {
    for (const double range : {6.5, 8191.9}) {
      const auto x = static_cast<float>(range * (2.0 * i / kPoints - 1));
      float s, c;
      sincos(x, s, c);
      const double error =
          std::max(std::abs(static_cast<double>(s) - std::sin(static_cast<double>(x))),
                   std::abs(static_cast<double>(c) - std::cos(static_cast<double>(x))));
      (range < 10 ? worst_near : worst) = std::max(range < 10 ? worst_near : worst, error);
      ASSERT_EQ(s, sin(x));
      ASSERT_EQ(c, cos(x));
    }
  }
  EXPECT_LT(worst_near, 1.2e-7);
  EXPECT_LT(worst, 1.2e-6);
  EXPECT_EQ(sin(0.0F), 0.0F);
  EXPECT_EQ(cos(0.0F), 1.0F);
}

TEST(Elementary, ArcTangent) {
  double worst = 0;
  std::mt19937 engine(2);
  std::uniform_real_distribution<float> exponent(-30, 30), sign(-1, 1);
  for (int i = 0; i < kPoints; ++i) {
    const float y = std::copysign(std::exp2(exponent(engine)), sign(engine));
    const float x = std::copysign(std::exp2(exponent(engine) * 0.5F) * std::abs(y), sign(engine));
    worst = std::max(worst,
                     ulps(atan2(y, x), std::atan2(static_cast<double>(y), static_cast<double>(x))));
  }
  EXPECT_LT(worst, 4);
  const auto pi = static_cast<float>(std::numbers::pi);
  EXPECT_EQ(atan2(0.0F, 0.0F), 0.0F);
  EXPECT_EQ(atan2(0.0F, 1.0F), 0.0F);
  EXPECT_EQ(atan2(0.0F, -1.0F), pi);
  EXPECT_EQ(atan2(-0.0F, -1.0F), -pi);
  EXPECT_EQ(atan2(1.0F, 0.0F), pi / 2);
  EXPECT_EQ(atan2(-1.0F, 0.0F), -pi / 2);
}

TEST(Elementary, ArcCosine) {
  double worst = 0;
  for (int i = 0; i <= kPoints; ++i) {
    const auto x = static_cast<float>(-1 + 2.0 * i / kPoints);
    worst =
        std::max(worst, std::abs(static_cast<double>(acos(x)) - std::acos(static_cast<double>(x))));
  }
  EXPECT_LT(worst, 5e-7);
  EXPECT_EQ(acos(1.0F), 0.0F);
  EXPECT_EQ(acos(2.0F), 0.0F);
  EXPECT_NEAR(static_cast<double>(acos(-1.5F)), std::numbers::pi, 3e-7);
  // Small angles keep their digits: 1 - x = theta^2 / 2.
  EXPECT_LT(ulps(acos(1 - 0x1p-24F), std::acos(1 - 0x1p-24)), 4);
}

TEST(Lanes, MinAndMaxDropANaNInFront) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(min(nan, 1.0F), 1.0F);
  EXPECT_EQ(max(nan, 1.0F), 1.0F);
  EXPECT_TRUE(std::isnan(min(1.0F, nan)));
}

TEST(Lanes, UnitNumbersStayBelowOne) {
  EXPECT_EQ(unit_from_bits(0U), 0.0F);
  EXPECT_LT(unit_from_bits(0xffffffffU), 1.0F);
  EXPECT_EQ(unit_from_bits(0x80000000U), 0.5F);
}

TEST(Lanes, ConversionsTruncate) {
  EXPECT_EQ(to_int(2.9F), 2U);
  EXPECT_EQ(to_int(-2.9F), static_cast<std::uint32_t>(-2));
  EXPECT_EQ(to_real(static_cast<std::uint32_t>(-7)), -7.0F);
}

LIGHTBENCH_KERNEL_END
