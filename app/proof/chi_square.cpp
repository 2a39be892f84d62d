#include "app/proof/chi_square.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace lightbench::proof {

double upper_incomplete_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {  // series of P
    double term = 1 / a, sum = term;
    for (double k = a + 1; term > sum * 1e-17; ++k) {
      term *= x / k;
      sum += term;
    }
    return 1 - front * sum;
  }
  // Lentz's continued fraction of Q.
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
  for (int i = 1; i < 10000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / (std::abs(an * d + b) < kTiny ? kTiny : an * d + b);
    c = std::abs(b + an / c) < kTiny ? kTiny : b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-16) break;
  }
  return front * h;
}

ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
  constexpr double kSmallest = 5;
  ChiSquare r;
  double pooled_observed = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double o, double e) {
    r.statistic += (o - e) * (o - e) / e;
    ++cells;
  };
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (expected[i] < 1e-6) r.stray += static_cast<std::size_t>(observed[i]);
    if (expected[i] >= kSmallest) {
      add(observed[i], expected[i]);
      continue;
    }
    pooled_observed += observed[i];
    pooled_expected += expected[i];
    if (pooled_expected < kSmallest) continue;
    add(pooled_observed, pooled_expected);
    pooled_observed = pooled_expected = 0;
  }
  if (pooled_expected > 0.5) add(pooled_observed, pooled_expected);
  r.freedom = cells - 1;
  if (r.freedom > 0) r.p_value = upper_incomplete_gamma(0.5 * r.freedom, 0.5 * r.statistic);
  if (std::isnan(r.statistic)) r.p_value = 0;
  return r;
}

double turn(double y, double x) {
  const double b = std::atan2(y, x) / (2 * std::numbers::pi);
  return b - std::floor(b);
}

double sidak(double alpha, std::size_t tests) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(tests));
}

}  // namespace lightbench::proof
