#pragma once
// Pearson's chi-square test of counts against expected counts, as Mitsuba's chi2 test does it:
// cells are pooled until each holds at least five, and a sample where none may fall fails at once.

#include <cstddef>
#include <vector>

namespace lightbench::proof {

struct ChiSquare {
  double statistic = 0;
  int freedom = 0;        ///< degrees of freedom
  double p_value = 1;     ///< probability of a statistic at least as large by chance
  std::size_t stray = 0;  ///< samples in cells that expect (practically) none
};

/// `expected` sums to the number of samples; so should `observed`.
ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected);

/// Q(a, x), the regularised upper incomplete gamma function; accurate to about 1e-12.
double upper_incomplete_gamma(double a, double x);

/// The azimuth of (x, y) as a share of a full turn, in [0,1]: a coordinate for cells.
double turn(double y, double x);

/// Significance of each of `tests` independent tests that together have significance `alpha`.
double sidak(double alpha, std::size_t tests);

}  // namespace lightbench::proof
