#include "app/bench/measurement.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace lightbench::bench {
namespace {

constexpr std::size_t kLeastRuns = 8;
constexpr double kMostSpp = 65536;

double mean_of(const Image& image) {
  return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0) /
         static_cast<double>(image.rgb.size());
}

Figures figures_of(const Subject& subject, const std::vector<Run>& runs,
                   const Reference& reference) {
  const auto curve_of = [&](std::span<const std::size_t> chosen) {
    return curve(runs, chosen, reference.mse, reference.relmse);
  };
  Figures f;
  f.runs = runs.size();
  std::vector<std::size_t> all(runs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  f.curve = curve_of(all);
  Counters counters;
  double seconds = 0;
  std::vector<double> biases;
  const double mean = mean_of(reference.image);
  for (const Run& run : runs) {
    counters += run.rungs.back().counters;
    seconds += run.rungs.back().seconds;
    biases.push_back(mean > 0 ? run.rungs.back().error.bias() / mean : 0);
  }
  f.samples_per_second = static_cast<double>(counters.paths) / seconds;
  f.rays_per_second = static_cast<double>(counters.rays + counters.shadow_rays) / seconds;
  f.vertex_nanoseconds = 1e9 * seconds * subject.threads /
                         static_cast<double>(std::max<std::uint64_t>(1, counters.rays));
  f.non_finite = counters.non_finite;
  f.bias = mean_interval(biases);
  // The reference's mean is not exact either; its values err independently.
  const double reference_half =
      mean > 0
          ? 1.96 * std::sqrt(reference.mse / static_cast<double>(reference.image.rgb.size())) / mean
          : 0;
  const double half = std::hypot(f.bias.high - f.bias.value, reference_half);
  f.bias.low = f.bias.value - half;
  f.bias.high = f.bias.value + half;
  const auto over_runs = [&](auto statistic) {
    return bootstrap(runs.size(), [&](auto chosen) { return statistic(curve_of(chosen)); });
  };
  f.relmse = over_runs([](const auto& c) { return c.back().relmse; });
  f.efficiency = over_runs([](const auto& c) { return efficiency(c); });
  f.seconds_to_1e2 = over_runs([](const auto& c) { return seconds_to(c, 1e-2); });
  f.seconds_to_1e3 = over_runs([](const auto& c) { return seconds_to(c, 1e-3); });
  return f;
}

Ratio ratio_of(const std::vector<Run>& first, const std::vector<Run>& other,
               const Reference& reference, double seconds) {
  const std::size_t count = std::min(first.size(), other.size());
  const auto over_pairs = [&](auto statistic) {
    return bootstrap(count, [&](auto chosen) {
      return statistic(curve(first, chosen, reference.mse, reference.relmse),
                       curve(other, chosen, reference.mse, reference.relmse));
    });
  };
  Ratio r;
  r.seconds = seconds;
  r.efficiency = over_pairs([seconds](const auto& a, const auto& b) {
    return relmse_at(a, seconds) / relmse_at(b, seconds);
  });
  r.sample_time = over_pairs([](const auto& a, const auto& b) {
    return a.back().seconds / a.back().spp / (b.back().seconds / b.back().spp);
  });
  return r;
}

}  // namespace

Measurement measure(const std::string& scene_file, const Reference& reference,
                    const std::vector<Subject>& subjects, double seconds,
                    const RunProgress& progress) {
  std::vector<std::unique_ptr<Bench>> benches;
  std::vector<std::uint32_t> spp;
  double round_seconds = 0;  // one run of each
  for (const Subject& subject : subjects) {
    benches.push_back(std::make_unique<Bench>(subject, reference.image));
    const double per_sample = benches.back()->seconds_per_sample();
    const double affordable =
        std::clamp(seconds / (static_cast<double>(kLeastRuns) * per_sample), 1.0, kMostSpp);
    spp.push_back(std::uint32_t{1} << static_cast<unsigned>(std::log2(affordable)));
    round_seconds += per_sample * spp.back();
  }
  const double budget = seconds * static_cast<double>(subjects.size());
  const std::size_t rounds = std::max(kLeastRuns, static_cast<std::size_t>(budget / round_seconds));
  std::vector<std::vector<Run>> runs(subjects.size());
  for (std::size_t i = 0; i < rounds; ++i) {
    progress(i, rounds, round_seconds * static_cast<double>(rounds - i));
    for (std::size_t k = 0; k < subjects.size(); ++k) {
      runs[k].push_back(benches[k]->run(static_cast<std::uint32_t>(i), spp[k]));
    }
  }
  Measurement m{scene_file, reference, {}};
  double equal_seconds = INFINITY;
  for (std::size_t k = 0; k < subjects.size(); ++k) {
    m.subjects.push_back({subjects[k],
                          benches[k]->stats(),
                          figures_of(subjects[k], runs[k], reference),
                          {},
                          benches[k]->error_map(),
                          benches[k]->bias_map(),
                          benches[k]->cost_map()});
    equal_seconds = std::min(equal_seconds, m.subjects.back().figures.curve.back().seconds);
  }
  for (std::size_t k = 1; k < subjects.size(); ++k) {
    m.subjects[k].ratio = ratio_of(runs[0], runs[k], reference, equal_seconds);
  }
  return m;
}

}  // namespace lightbench::bench
