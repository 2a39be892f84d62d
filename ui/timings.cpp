#include "ui/timings.h"

#include <algorithm>
#include <cmath>

namespace lightbench::ui {
namespace {
constexpr std::size_t kKept = 512;
}

void Timings::add(double seconds) {
  if (seconds_.size() < kKept) {
    seconds_.push_back(seconds);
  } else {
    seconds_[next_] = seconds;
    next_ = (next_ + 1) % kKept;
  }
}

double Timings::quantile(double share) const {
  if (seconds_.empty()) return 0;
  std::vector<double> sorted = seconds_;
  const auto rank =
      static_cast<std::size_t>(std::lround(share * static_cast<double>(sorted.size() - 1)));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                   sorted.end());
  return sorted[rank];
}

}  // namespace lightbench::ui
