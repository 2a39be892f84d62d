// The test of the tests: a wrong p-value would let everything else here pass.

#include "app/proof/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lightbench::statistics {
using namespace proof;
namespace {

TEST(ChiSquare, PValuesAreThoseOfTheTables) {
  // Critical values of any statistics book: upper tail of chi-square.
  EXPECT_NEAR(upper_incomplete_gamma(0.5, 0.5 * 3.841458820694124), 0.05, 1e-12);
  EXPECT_NEAR(upper_incomplete_gamma(5, 0.5 * 18.30703805327514), 0.05, 1e-12);
  EXPECT_NEAR(upper_incomplete_gamma(50, 0.5 * 135.8067231740279), 0.01, 1e-9);
  EXPECT_NEAR(upper_incomplete_gamma(1, 3), std::exp(-3.0), 1e-15);
  EXPECT_NEAR(upper_incomplete_gamma(500, 500), 0.4940529, 1e-6);
}

TEST(ChiSquare, SidakKeepsTheSignificanceOfTheWhole) {
  EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 101), 101), 0.01, 1e-12);
  EXPECT_DOUBLE_EQ(sidak(0.01, 1), 0.01);
}

TEST(ChiSquare, AcceptsItsOwnDistributionAndRejectsAnother) {
  std::mt19937 engine(1);
  const int n = 20000, cells = 100;
  std::vector<double> fair(cells), loaded(cells), expected(cells, double{n} / cells);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < n; ++i) {
    const double u = uniform(engine);
    fair[static_cast<std::size_t>(u * cells)] += 1;
    loaded[static_cast<std::size_t>(std::pow(u, 1.2) * cells)] += 1;
  }
  EXPECT_GT(chi_square(fair, expected).p_value, 0.01);
  EXPECT_LT(chi_square(loaded, expected).p_value, 1e-4);
}

TEST(ChiSquare, CountsSamplesWhereNoneMayFall) {
  EXPECT_EQ(chi_square({10, 90, 2}, {10, 92, 0}).stray, 2U);
  EXPECT_EQ(chi_square({10, 90, 0}, {10, 90, 0}).stray, 0U);
}

}  // namespace
}  // namespace lightbench::statistics
