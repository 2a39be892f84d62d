#include "app/stress/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/proof/measure.h"

namespace lightbench::stress {
using namespace proof;
namespace {

constexpr double kPrecision = 3e-4, kLargestDeviation = 1e-3;
constexpr int kCertainSamples = 8, kLeastSamples = 256, kMostSamples = 1 << 16;  ///< per pixel
/// Of thousands of pictures some deviate by three standard errors, which is the largest deviation:
/// those are measured again, this many times as precisely.
constexpr int kCloser = 4;

/// What the arithmetic of a path may lose by itself, relative; tests/transport allows the same.
double arithmetic_of(Precision precision) { return precision == Precision::Double ? 1e-7 : 5e-6; }

void judge(Random& random, const DrawPicture& draw, KernelKind kernel, std::span<Tally> tallies) {
  // What compile() picks is asked no more than float can answer.
  const Precision asked = kernel == KernelKind::Auto ? Precision::Float : precision_of(kernel);
  const KnownPicture known = draw(random, asked);
  const double unit = std::max({known.low, known.high, known.unit, kDark});
  const double pixels = known.scene.render.width * known.scene.render.height;
  // Rare events that none of N samples met leave no trace in the spread. Where their share is known
  // so is the N that it takes.
  const double least = known.high * (known.event - known.high) / std::pow(kPrecision * unit, 2);
  const int least_spp =
      known.certain
          ? kCertainSamples
          : static_cast<int>(std::clamp<double>(least / pixels, kLeastSamples, kMostSamples));
  const SizedEstimate e =
      measure_uniform_to(known.scene, kernel, kPrecision * unit, least_spp, kMostSamples);
  // A share q of them goes unmet with probability exp(-N q), which is that of 5 standard errors at
  // q = 15 / N.
  const double event = known.event > 0 ? known.event : unit;
  const double unseen = known.certain ? 0 : 3 * event / (pixels * e.spp);
  const auto distance = [&known](double y) {
    return std::isfinite(y) ? std::max({0.0, known.low - y, y - known.high})
                            : std::numeric_limits<double>::infinity();
  };
  const double excess = std::max(0.0, distance(e.mean.y) - arithmetic_of(asked) * unit);
  const double t = excess == 0 ? 0 : excess / std::max(e.error.y, unseen);
  SizedEstimate close = e;
  const auto text = [&] {
    return fmt::format("{}: expected {:.9g}, measured {:.9g} +- {:.2g}", known.what,
                       0.5 * (known.low + known.high), close.mean.y, close.error.y);
  };
  for (Tally& tally : tallies) tally.trial();
  tallies[0].measure(std::isfinite(t) ? equivalent_z(t, e.freedom) : t, text);
  // One that stays noisy is no comparison.
  const auto noisy = [&] { return close.error.y > 2 * kPrecision * unit; };
  if (noisy() || distance(e.mean.y) > kLargestDeviation * unit) {
    close = measure_uniform_to(known.scene, kernel, kPrecision / kCloser * unit, e.spp,
                               kCloser * kCloser * kMostSamples);
  }
  tallies[1].measure(noisy() ? 1 : distance(close.mean.y) / unit, text);
}

}  // namespace

double rounding_of(Precision precision) {
  return precision == Precision::Double ? 0x1p-53 : 0x1p-24;
}

void add_known_pictures(std::vector<Test>& tests, const std::string& name,
                        const std::string& distribution, std::uint64_t short_trials,
                        std::uint64_t long_trials, const DrawPicture& draw) {
  tests.push_back(
      {name,
       distribution,
       {{name + ", chance", "deviation from the formula in standard errors", kLargestDeviate,
         kLargestDeviate, 0},
        {name + ", deviation",
         fmt::format("deviation from the formula, relative (to {} where it is darker)", kDark),
         kLargestDeviation, kLargestDeviation, 0}},
       short_trials,
       long_trials,
       1,
       [draw](KernelKind kernel) -> Chunk {
         return [draw, kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             judge(random, draw, kernel, tallies);
           }
         };
       }});
}

}  // namespace lightbench::stress
