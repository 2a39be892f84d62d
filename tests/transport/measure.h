#pragma once
// Rendering small pictures and reading means from them, without a session.

#include <ostream>

#include "core/compile/render_scene.h"
#include "core/film/film.h"
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

/// The whole picture with `spp` samples in every pixel, from sample number `first`.
Film render_film(const RenderScene& scene, int spp, int first = 0);
Film render_film(const Scene& scene, KernelKind kernel, int spp);

/// Mean radiance of film pixel i, in double.
glm::dvec3 pixel_mean(const Film& film, std::size_t i, int spp);

/// For pictures that should show one radiance throughout: pixels scramble their sequences
/// independently, so their means are independent estimates of it.
Estimate measure_uniform(const Scene& scene, KernelKind kernel, int spp);

/// Whole-picture mean over `seeds` renders with seeds of their own, for pictures that show more.
Estimate measure_by_seeds(Scene scene, KernelKind kernel, int spp, int seeds);

}  // namespace lightbench
