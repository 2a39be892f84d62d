#pragma once
// Rules of numerical integration.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace lightbench::stress {

/// Nodes and weights of Gauss and Legendre on [0,1], by Newton's iteration.
template <std::size_t kCount>
std::array<std::pair<double, double>, kCount> gauss() {
  std::array<std::pair<double, double>, kCount> rule;
  for (std::size_t i = 0; i < kCount; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (kCount + 0.5));
    double slope = 1;
    for (int step = 0; step < 60; ++step) {
      double p0 = 1, p1 = x;
      for (std::size_t k = 2; k <= kCount; ++k) {
        const auto n = static_cast<double>(k);
        const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = static_cast<double>(kCount) * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    rule[i] = {0.5 * (x + 1), 1 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

}  // namespace lightbench::stress
