#include "app/proof/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lightbench::proof {
namespace {

/// Share of a normal distribution beyond +-z.
double two_sided_tail(double z) { return std::erfc(z / std::numbers::sqrt2); }

/// The regularized incomplete beta function I_x(a, b) by its continued fraction (Lentz's method;
/// Press et al. 1992, 6.4), which converges for x below about its mean.
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / away_from_zero(1 - (a + b) * x / (a + 1)), value = d;
  for (int m = 1; m < 1000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    value *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    value *= d * c;
    if (std::abs(d * c - 1) < 1e-14) break;
  }
  return front * value / a;
}

}  // namespace

Estimate summarize(const std::vector<glm::dvec3>& replicates) {
  const auto n = static_cast<double>(replicates.size());
  Estimate e;
  for (const glm::dvec3& r : replicates) e.mean += r / n;
  glm::dvec3 squares(0);
  for (const glm::dvec3& r : replicates) squares += (r - e.mean) * (r - e.mean);
  for (int k = 0; k < 3; ++k) e.error[k] = std::sqrt(squares[k] / (n - 1) / n);
  e.freedom = n - 1;
  return e;
}

Mean mean_of(std::span<const double> replicates) {
  const auto n = static_cast<double>(replicates.size());
  Mean m{0, 0, n - 1};
  for (const double r : replicates) m.value += r / n;
  double squares = 0;
  for (const double r : replicates) squares += (r - m.value) * (r - m.value);
  m.error = std::sqrt(squares / (n - 1) / n);
  return m;
}

double equivalent_z(double t, double freedom) {
  const double z =
      std::sqrt(freedom * std::log1p(t * t / freedom)) * (8 * freedom + 1) / (8 * freedom + 3);
  return std::copysign(z, t);
}

double sidak_limit(double level, std::size_t members) {
  const double each = -std::expm1(std::log1p(-level) / static_cast<double>(members));
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (two_sided_tail(middle) > each ? low : high) = middle;
  }
  return high;
}

double student_tail(double t, double freedom) {
  return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t));
}

double student_quantile(double tail, double freedom) {
  double low = 0, high = 1;
  while (student_tail(high, freedom) > tail) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (student_tail(middle, freedom) > tail ? low : high) = middle;
  }
  return high;
}

Welch welch(const Mean& a, const Mean& b) {
  const double va = a.error * a.error, vb = b.error * b.error, v = va + vb;
  Welch w;
  w.freedom = v * v / (va * va / a.freedom + vb * vb / b.freedom);  // Welch and Satterthwaite
  w.t = (a.value - b.value) / std::sqrt(v);
  w.p = student_tail(w.t, w.freedom);
  return w;
}

double uniformity(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  const auto n = static_cast<double>(p.size());
  double distance = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto k = static_cast<double>(i);
    // Written so that a p-value that is not a number counts as far off.
    if (!(p[i] - k / n <= distance)) distance = p[i] - k / n;
    if (!((k + 1) / n - p[i] <= distance)) distance = (k + 1) / n - p[i];
  }
  if (!(distance <= 1)) return 0;
  const double x = (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n)) * distance;
  if (x < 0.2) return 1;  // the series below needs many terms there, and its sum is 1
  double tail = 0;
  for (int k = 1; k < 100; ++k) tail += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(tail, 0.0, 1.0);
}

}  // namespace lightbench::proof
