// The sample sequence: stratified as a (0,2)-sequence should be by pairs of dimensions and as a
// (0,4)-sequence by sets of four, yet different for every pixel and set. Integers, so one number
// type tells all.

#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE

#include "core/sampling/sobol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "app/proof/chi_square.h"

LIGHTBENCH_KERNEL_BEGIN

Sampler sampler_of(std::uint32_t pixel, std::uint32_t seed, std::uint32_t sample) {
  return {hash(hash(pixel % 640, pixel / 640), seed), reverse_bits(sample)};
}

/// First half of a set for an even number, second half for an odd one.
Bits2 pair_bits(const Sampler& sampler, std::uint32_t pair) {
  return pair % 2 == 0 ? sampler.first_bits(pair / 2) : sampler.second_bits(pair / 2);
}
Vec2 pair_of(const Sampler& sampler, std::uint32_t pair) {
  return unit_from_bits(pair_bits(sampler, pair));
}

TEST(Sobol, EveryElementaryIntervalHoldsOnePoint) {
  int violations = 0;
  for (const std::uint32_t pixel : {0U, 77U, 123456U}) {
    for (const std::uint32_t pair : {0U, 1U, 2U, 3U, 6U, 17U, 66000U, 66001U}) {
      for (unsigned k = 0; k <= 10; ++k) {
        const std::uint32_t n = 1U << k;
        // Any aligned block of 2^k samples, not only the first.
        for (const std::uint32_t first : {0U, 3 * n, 8 * n}) {
          std::vector<Bits2> points;
          for (std::uint32_t i = 0; i < n; ++i) {
            points.push_back(pair_bits(sampler_of(pixel, 9, first + i), pair));
          }
          for (unsigned columns = 0; columns <= k; ++columns) {
            std::vector<int> count(n);
            for (const auto& p : points) {
              const std::uint64_t x = (std::uint64_t{p.x} << columns) >> 32;
              const std::uint64_t y = (std::uint64_t{p.y} << (k - columns)) >> 32;
              ++count[(x << (k - columns)) + y];
            }
            for (const int c : count) violations += c == 1 ? 0 : 1;
          }
        }
      }
    }
  }
  EXPECT_EQ(violations, 0);
}

TEST(Sobol, EveryBoxOfFourDimensionsHoldsOnePoint) {
  int violations = 0;
  for (const std::uint32_t set : {0U, 3U, 17U, 66000U}) {
    for (unsigned k = 0; k <= 5; ++k) {
      const std::uint32_t n = 1U << (2 * k);
      for (const std::uint32_t first : {0U, 3 * n}) {
        std::vector<std::array<std::uint32_t, 4>> points;
        for (std::uint32_t i = 0; i < n; ++i) {
          const Sampler s = sampler_of(77, 9, first + i);
          const Bits2 a = s.first_bits(set), b = s.second_bits(set);
          points.push_back({a.x, a.y, b.x, b.y});
        }
        // Sides of 4^-e for all e that add up to k.
        for (unsigned code = 0; code < 6 * 6 * 6; ++code) {
          const std::array<unsigned, 3> e{code % 6, code / 6 % 6, code / 36};
          if (e[0] + e[1] + e[2] > k) continue;
          std::vector<int> count(n);
          for (const auto& p : points) {
            std::uint64_t box = 0;
            for (unsigned d = 0; d < 4; ++d) {
              const unsigned digits = d < 3 ? e[d] : k - e[0] - e[1] - e[2];
              box = (box << (2 * digits)) + ((std::uint64_t{p[d]} << (2 * digits)) >> 32);
            }
            ++count[box];
          }
          for (const int c : count) violations += c == 1 ? 0 : 1;
        }
      }
    }
  }
  EXPECT_EQ(violations, 0);
}

TEST(Sobol, EitherHalfIsTheOneThatIsAskedFor) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    for (const bool independent : {false, true}) {
      Sampler s = sampler_of(i, 3, 7 * i);
      s.independent = independent;
      for (const bool second : {false, true}) {
        const Bits2 a = s.either_bits(i % 5, Mask(second));
        const Bits2 b = second ? s.second_bits(i % 5) : s.first_bits(i % 5);
        EXPECT_EQ(a.x, b.x);
        EXPECT_EQ(a.y, b.y);
      }
    }
  }
}

TEST(Sobol, ManySamplesFillTheSquareEvenlyAndStayBelowOne) {
  for (const std::uint32_t pair : {0U, 5U, 10U}) {
    double sum_x = 0, sum_y = 0, sum_xy = 0;
    constexpr int kSamples = 65536;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      const Vec2 u = pair_of(sampler_of(5, 0, i), pair);
      ASSERT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
      sum_x += u.x;
      sum_y += u.y;
      sum_xy += u.x * u.y;
    }
    EXPECT_NEAR(sum_x / kSamples, 0.5, 1e-5);
    EXPECT_NEAR(sum_y / kSamples, 0.5, 1e-5);
    EXPECT_NEAR(sum_xy / kSamples, 0.25, 1e-4);
  }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  const auto n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    sa += a[i];
    sb += b[i];
    saa += a[i] * a[i];
    sbb += b[i] * b[i];
    sab += a[i] * b[i];
  }
  return (n * sab - sa * sb) / std::sqrt((n * saa - sa * sa) * (n * sbb - sb * sb));
}

/// The first `n` values of one coordinate.
std::vector<double> values(std::uint32_t pixel, std::uint32_t pair, bool second, std::uint32_t n) {
  std::vector<double> v;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec2 u = pair_of(sampler_of(pixel, 0, i), pair);
    v.push_back(second ? u.y : u.x);
  }
  return v;
}

TEST(Sobol, PairsAndPixelsAreIndependent) {
  // Of 1000 pairs of sequences of n numbers. Independent random numbers would scatter by 1/sqrt(n);
  // points that are stratified in twos, fours, ... by 1.25 times that.
  constexpr std::uint32_t kSamples = 1024;
  double squares = 0, worst = 0;
  int count = 0;
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b) {
    const double r = correlation(a, b);
    squares += r * r;
    worst = std::max(worst, std::abs(r));
    ++count;
  };
  for (std::uint32_t k = 0; k < 250; ++k) {
    compare(values(k, 3, false, kSamples), values(k + 1, 3, false, kSamples));   // neighbours
    compare(values(k, 3, false, kSamples), values(k + 640, 3, true, kSamples));  // the row below
    compare(values(k, k, false, kSamples), values(k, k + 1, false, kSamples));   // next pair
    compare(values(k, k, true, kSamples), values(k, k + 4, true, kSamples));     // next vertex
  }
  const double rms = std::sqrt(squares / count) * std::sqrt(double{kSamples});
  EXPECT_LT(rms, 1.35);
  EXPECT_LT(worst * std::sqrt(double{kSamples}), 6.0);
}

TEST(Sobol, TwoDimensionsOfDifferentPairsFillTheirSquare) {
  // The joint distribution of coordinates of different pairs: padded sequences are merely random
  // against each other, but no worse; halves of one set are no worse either. Over many pixels,
  // since one pixel's points are not random.
  constexpr std::size_t kCells = 16;
  constexpr std::uint32_t kPixels = 4000, kSamples = 4;
  constexpr std::pair<std::uint32_t, std::uint32_t> kPairs[] = {{3, 4}, {6, 8}, {6, 7}};
  for (const auto& [first, second] : kPairs) {
    std::vector<double> observed(kCells * kCells);
    for (std::uint32_t p = 0; p < kPixels; ++p) {
      for (std::uint32_t i = 0; i < kSamples; ++i) {
        const Sampler s = sampler_of(p, 1, i);
        const auto x = static_cast<std::size_t>(pair_of(s, first).x * kCells);
        const auto y = static_cast<std::size_t>(pair_of(s, second).y * kCells);
        observed[x * kCells + y] += 1;
      }
    }
    const std::vector<double> expected(kCells * kCells,
                                       double{kPixels} * kSamples / kCells / kCells);
    EXPECT_GT(proof::chi_square(observed, expected).p_value, 0.001) << first << " and " << second;
  }
}

TEST(Sobol, ScaledBitsAreTheExactProduct) {
  std::mt19937_64 engine(3);
  for (int k = 0; k < 100000; ++k) {
    const auto bits = static_cast<std::uint32_t>(engine());
    const auto n = static_cast<std::uint32_t>(engine()) >> (engine() % 32);
    ASSERT_EQ(scale_bits(bits, n), static_cast<std::uint32_t>((std::uint64_t{bits} * n) >> 32))
        << bits << " " << n;
  }
  for (const std::uint32_t n : {1U, 2U, 0xffffU, 0x10000U, 0xffffffffU}) {
    for (const std::uint32_t bits : {0U, 1U, 0xffffU, 0x10000U, 0xffffffffU}) {
      EXPECT_EQ(scale_bits(bits, n), static_cast<std::uint32_t>((std::uint64_t{bits} * n) >> 32))
          << bits << " " << n;
    }
  }
}

TEST(Hash, FlippingAnyInputBitFlipsHalfTheOutput) {
  constexpr int kTrials = 4000;
  std::mt19937 engine(4);
  double worst = 0;
  for (int second = 0; second < 3; ++second) {  // hash(x), hash(x, b), hash(a, x)
    const auto f = [second](std::uint32_t x) {
      return second == 0 ? hash(x) : second == 1 ? hash(x, 12345U) : hash(777U, x);
    };
    for (unsigned bit = 0; bit < 32; ++bit) {
      std::vector<int> flips(32);
      for (int k = 0; k < kTrials; ++k) {
        const auto x = static_cast<std::uint32_t>(engine());
        const std::uint32_t d = f(x) ^ f(x ^ (1U << bit));
        for (unsigned o = 0; o < 32; ++o) flips[o] += static_cast<int>(d >> o & 1U);
      }
      for (const int n : flips) worst = std::max(worst, std::abs(double(n) / kTrials - 0.5));
    }
  }
  // 3072 binomials of 4000: five standard deviations are 0.04.
  EXPECT_LT(worst, 0.045);
}

TEST(Hash, IsABijection) {
  std::set<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < 100000; ++i) seen.insert(hash(i));
  EXPECT_EQ(seen.size(), 100000U);
}

LIGHTBENCH_KERNEL_END
