#pragma once
// What rendering counts, and the samples that it could not add to the film.

#include <cstdint>

namespace lightbench {

/// Why a sample was dropped, by its worst colour component.
enum class Fault { NotANumber, Infinite, Negative, BeyondFilm };
inline constexpr int kFaults = 4;
/// "NaN", "infinite", "negative" or "beyond the film's range".
const char* fault_name(Fault fault);

/// Names a sample: picture pixel and index.
struct SampleName {
  int x = -1, y = -1;
  std::uint32_t sample = 0;
};

/// What tracing counted; add up over threads. Does not depend on the order of adding.
struct Counters {
  std::uint64_t paths = 0;
  std::uint64_t rays = 0;  ///< path segments
  std::uint64_t shadow_rays = 0;
  std::uint64_t non_finite = 0;         ///< samples dropped, of all kinds
  std::uint64_t faults[kFaults] = {};   ///< of each kind
  SampleName bad;                       ///< the first of them, by sample index, then row by row
  Fault bad_fault = Fault::NotANumber;  ///< what is wrong with it

  Counters& operator+=(const Counters& other);
  /// Counts a dropped sample.
  void drop(const SampleName& name, Fault fault);
};

}  // namespace lightbench
