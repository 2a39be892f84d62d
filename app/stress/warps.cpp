// Warps that no query reaches, at the ends of the random numbers' range.

#include <fmt/format.h>

#include <cmath>

#include "app/stress/kernel_functions.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

constexpr double kEdges[] = {0, 0x1p-53, 0x1p-32, 0x1p-24, 0.5, 1 - 0x1p-24, 1 - 0x1p-53};
constexpr const char* kNames[] = {"box filter", "tent filter", "Gaussian filter", "lens",
                                  "sphere",     "hemisphere",  "free flight"};
static_assert(std::size(kNames) == kWarps);

/// Within the support, and unit where it is a direction; 1e-6 for rounding.
bool sound(Warp warp, const double (&p)[3]) {
  for (const double x : p) {
    if (!std::isfinite(x)) return false;
  }
  constexpr double kOne = 1 + 1e-6;
  const double radius = std::sqrt(p[0] * p[0] + p[1] * p[1]);
  switch (warp) {
    case Warp::BoxFilter:
    case Warp::TentFilter:
      return std::abs(p[0]) <= kOne && std::abs(p[1]) <= kOne;
    case Warp::GaussianFilter:
    case Warp::Lens:
      return radius <= kOne;
    case Warp::Sphere:
      return std::abs(std::hypot(radius, p[2]) - 1) <= 1e-6;
    case Warp::Hemisphere:
      return std::abs(std::hypot(radius, p[2]) - 1) <= 1e-6 && p[2] >= 0;
    case Warp::FreeFlight:
      return p[0] >= 0;
  }
  return false;
}

}  // namespace

void add_warp_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"warps of the square",
       "pixel filters, lens, phase function, cosine hemisphere, free flight; all pairs from {0, "
       "2^-53, 2^-32, 2^-24, .5, 1-2^-24, 1-2^-53}, then random ones",
       {{"warps, NaN, infinite, outside or not unit", "", kNoLimit, kNoLimit, 0}},
       100'000,
       100'000'000,
       1U << 20U,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           constexpr std::uint64_t kPairs = std::size(kEdges) * std::size(kEdges);
           for (std::uint64_t i = 0; i < trials; ++i) {
             const bool edge = i < kPairs * kWarps;
             const auto warp = static_cast<Warp>(i % kWarps);
             const std::uint64_t pair = i / kWarps;
             const double first = random.unit(), second = random.unit();
             const double u[2] = {edge ? kEdges[pair % std::size(kEdges)] : first,
                                  edge ? kEdges[pair / std::size(kEdges)] : second};
             double p[3];
             functions_of(kernel).warp(warp, u, p);
             tallies[0].trial();
             if (sound(warp, p)) continue;
             tallies[0].fail([&] {
               return fmt::format("{} of {:.17g} {:.17g}: {:.17g} {:.17g} {:.17g}",
                                  kNames[i % kWarps], u[0], u[1], p[0], p[1], p[2]);
             });
           }
         };
       }});
}

}  // namespace lightbench::stress
