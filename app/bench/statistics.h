#pragma once
// From the errors of independent runs to figures with confidence intervals.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "app/bench/subject.h"

namespace lightbench::bench {

/// An estimate and its 95 % confidence interval.
struct Interval {
  double value = 0, low = 0, high = 0;
};

/// Mean of independent values, by Student's t.
Interval mean_interval(const std::vector<double>& values);

/// A statistic of the runs, its interval by the percentile bootstrap over runs (Efron & Tibshirani
/// 1993, ch. 13): 1000 resamples, fixed seed. `count` runs are drawn from together, so that figures
/// of several subjects whose runs were interleaved can be compared.
Interval bootstrap(std::size_t count,
                   const std::function<double(std::span<const std::size_t> chosen)>& statistic);

/// Means over runs at one rung.
struct CurvePoint {
  double spp = 0, seconds = 0;
  double mse = 0, relmse = 0, trimmed_relmse = 0;
  double relmse_deviation = 0;  ///< standard deviation of relMSE between runs
};

/// The error of the reference itself is subtracted: its noise is not the render's.
std::vector<CurvePoint> curve(const std::vector<Run>& runs, std::span<const std::size_t> chosen,
                              double reference_mse, double reference_relmse);

/// Seconds at which the curve falls to `relmse`: between rungs along a straight line in log-log,
/// beyond the last as 1 / seconds. 0 if the first rung is already below.
double seconds_to(const std::vector<CurvePoint>& curve, double relmse);

/// relMSE after `seconds`, between the first rung and the last along straight lines in log-log.
double relmse_at(const std::vector<CurvePoint>& curve, double seconds);

/// 1 / (relMSE seconds) at the last rung.
double efficiency(const std::vector<CurvePoint>& curve);

}  // namespace lightbench::bench
