#include "app/bench/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "app/proof/statistics.h"

namespace lightbench::bench {
namespace {

/// What a statistic that has no value (0 / 0 in a scene without noise) counts as.
double or_zero(double x) { return std::isnan(x) ? 0 : x; }

}  // namespace

Interval mean_interval(const std::vector<double>& values) {
  const proof::Mean mean = proof::mean_of(values);
  if (values.size() < 2) return {mean.value, -INFINITY, INFINITY};
  const double half = proof::student_quantile(0.05, mean.freedom) * mean.error;
  return {mean.value, mean.value - half, mean.value + half};
}

Interval bootstrap(std::size_t count,
                   const std::function<double(std::span<const std::size_t> chosen)>& statistic) {
  std::vector<std::size_t> chosen(count);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  Interval result;
  result.value = or_zero(statistic(chosen));
  constexpr std::size_t kResamples = 1000;
  std::mt19937 engine(1);
  std::uniform_int_distribution<std::size_t> any(0, count - 1);
  std::vector<double> values;
  for (std::size_t i = 0; i < kResamples; ++i) {
    for (std::size_t& c : chosen) c = any(engine);
    values.push_back(or_zero(statistic(chosen)));
  }
  std::sort(values.begin(), values.end());
  result.low = values[kResamples * 25 / 1000];
  result.high = values[kResamples * 975 / 1000 - 1];
  return result;
}

std::vector<CurvePoint> curve(const std::vector<Run>& runs, std::span<const std::size_t> chosen,
                              double reference_mse, double reference_relmse) {
  std::vector<CurvePoint> points;
  const auto n = static_cast<double>(chosen.size());
  for (std::size_t k = 0; k < runs.front().rungs.size(); ++k) {
    CurvePoint p;
    double squares = 0;
    for (const std::size_t i : chosen) {
      const Rung& rung = runs[i].rungs[k];
      p.spp = rung.spp;
      p.seconds += rung.seconds / n;
      p.mse += rung.error.mse / n;
      p.relmse += rung.error.relmse / n;
      p.trimmed_relmse += rung.error.trimmed_relmse / n;
      squares += rung.error.relmse * rung.error.relmse / n;
    }
    p.relmse_deviation =
        std::sqrt(std::max(0.0, squares - p.relmse * p.relmse) * n / std::max(1.0, n - 1));
    // What is left below a hundredth of the reference's own error is not known.
    p.mse = std::max(p.mse - reference_mse, 0.01 * reference_mse);
    p.relmse = std::max(p.relmse - reference_relmse, 0.01 * reference_relmse);
    p.trimmed_relmse = std::max(p.trimmed_relmse - reference_relmse, 0.01 * reference_relmse);
    points.push_back(p);
  }
  return points;
}

double seconds_to(const std::vector<CurvePoint>& curve, double relmse) {
  if (curve.front().relmse <= relmse) return 0;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    const CurvePoint &a = curve[k - 1], &b = curve[k];
    if (b.relmse > relmse) continue;
    const double share = std::log(a.relmse / relmse) / std::log(a.relmse / b.relmse);
    return a.seconds * std::pow(b.seconds / a.seconds, share);
  }
  return curve.back().seconds * curve.back().relmse / relmse;
}

double relmse_at(const std::vector<CurvePoint>& curve, double seconds) {
  std::size_t k = 1;
  while (k + 1 < curve.size() && curve[k].seconds < seconds) ++k;
  if (curve.size() < 2) return curve.front().relmse;
  const CurvePoint &a = curve[k - 1], &b = curve[k];
  const double share =
      std::clamp(std::log(seconds / a.seconds) / std::log(b.seconds / a.seconds), 0.0, 1.0);
  return a.relmse * std::pow(b.relmse / a.relmse, share);
}

double efficiency(const std::vector<CurvePoint>& curve) {
  return 1 / (curve.back().relmse * curve.back().seconds);
}

}  // namespace lightbench::bench
