#pragma once
// The kernels under test, and what their comparisons may cost.

#include <ostream>

#include "app/proof/measure.h"
#include "tests/transport/statistics.h"

namespace lightbench {

/// The build of the kernel under test and how much it may be asked to do: the reference kernel is
/// slow, so it takes fewer samples and its comparisons are coarser.
struct KernelUnderTest {
  KernelKind kind;
  int spp_divisor;
  double precision;  ///< relative standard error that its comparisons must reach
  double rounding;   ///< relative error allowed for its arithmetic
  [[nodiscard]] int spp(int full) const { return full > spp_divisor ? full / spp_divisor : 1; }
  [[nodiscard]] Family family() const { return {precision, rounding}; }
};
#ifdef __SANITIZE_ADDRESS__
// Watched for its use of memory, a kernel is some fifty times slower and a few samples take every
// path through it: comparisons only find what is grossly wrong.
inline constexpr int kThinning = 32;
inline constexpr double kCoarsening = 25;
#else
inline constexpr int kThinning = 1;
inline constexpr double kCoarsening = 1;
#endif
inline constexpr KernelUnderTest kFastKernel{KernelKind::Auto, kThinning, 1e-3 * kCoarsening, 5e-6};
inline constexpr KernelUnderTest kReferenceKernel{KernelKind::Reference, 8 * kThinning,
                                                  4e-3 * kCoarsening, 1e-7};
std::ostream& operator<<(std::ostream& out, const KernelUnderTest& kernel);

}  // namespace lightbench
