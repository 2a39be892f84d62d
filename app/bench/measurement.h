#pragma once
// All runs of a scene's subjects, and the figures that follow from them.

#include <functional>
#include <string>
#include <vector>

#include "app/bench/reference.h"
#include "app/bench/statistics.h"
#include "app/bench/subject.h"

namespace lightbench::bench {

/// Figures of one subject; means over its runs, at the last rung unless said otherwise.
struct Figures {
  std::size_t runs = 0;
  std::vector<CurvePoint> curve;
  double samples_per_second = 0;            ///< camera paths
  double rays_per_second = 0;               ///< path segments and shadow rays
  double vertex_nanoseconds = 0;            ///< of one thread, per path segment
  Interval relmse, efficiency;              ///< 1 / (relMSE s)
  Interval bias;                            ///< of the picture's mean, relative; should hold 0
  Interval seconds_to_1e2, seconds_to_1e3;  ///< to relMSE .01 and .001
  std::uint64_t non_finite = 0;
};

/// Of a subject against the first one.
struct Ratio {
  double seconds = 0;    ///< equal time at which the errors are compared
  Interval efficiency;   ///< error of the first / error of this one, above 1: this one is better
  Interval sample_time;  ///< seconds per sample of the first / of this one
};

struct SubjectResult {
  Subject subject;
  RenderStats stats;
  Figures figures;
  Ratio ratio;
  std::vector<float> error_map, bias_map, cost_map;  ///< per pixel, subject.h
};

struct Measurement {
  std::string scene_file;
  Reference reference;
  std::vector<SubjectResult> subjects;
};

/// Called before each run: runs done, runs in all, seconds left by the plan.
using RunProgress = std::function<void(std::size_t done, std::size_t all, double seconds_left)>;

/// Renders the subjects in turn, run by run, each for about `seconds`: at least eight runs, of as
/// many samples (a power of two) as that leaves. All have the reference's size.
Measurement measure(const std::string& scene_file, const Reference& reference,
                    const std::vector<Subject>& subjects, double seconds,
                    const RunProgress& progress);

}  // namespace lightbench::bench
