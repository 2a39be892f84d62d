#pragma once
// The last few hundred durations of something, for the median and the slow end.

#include <cstddef>
#include <vector>

namespace lightbench::ui {

class Timings {
 public:
  void add(double seconds);
  [[nodiscard]] std::size_t count() const { return seconds_.size(); }
  /// The value below which `share` (0..1) of them lie; 0 if there are none.
  [[nodiscard]] double quantile(double share) const;

 private:
  std::vector<double> seconds_;  ///< a ring once full
  std::size_t next_ = 0;
};

}  // namespace lightbench::ui
