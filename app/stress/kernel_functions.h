#pragma once
// Functions of the kernels that no query reaches, with arguments of one's choice. They are compiled
// here once more for one float and one double lane; wider kernels give the same bits.

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/compile/render_scene.h"
#include "core/query/rays.h"

namespace lightbench::stress {

enum class Warp { BoxFilter, TentFilter, GaussianFilter, Lens, Sphere, Hemisphere, FreeFlight };
inline constexpr int kWarps = 7;

/// The nearest of all surfaces.
struct LoopHit {
  int object = kNone, triangle = kNone;
  double t = std::numeric_limits<double>::infinity();  ///< along a unit direction
  bool operator==(const LoopHit&) const = default;
};

struct KernelFunctions {
  /// By a loop over all surfaces and all triangles of all meshes. The scene was compiled for a
  /// kernel of this number type; the rays' directions are unit to the last bit.
  void (*nearest_by_loop)(const RenderScene& scene, std::span<const Ray> rays,
                          std::span<LoopHit> hits);
  /// By a test of this object alone, of a mesh this triangle alone. The same conditions.
  LoopHit (*hit_alone)(const RenderScene& scene, const Ray& ray, int object, int triangle);
  /// The warp of u, rounded to the kernel's number type below 1; unused components are 0. Filters
  /// are of radius 1.
  void (*warp)(Warp warp, const double (&u)[2], double (&out)[3]);
  /// Samples first, first + 1, ... of a pair of dimensions of picture pixel (x, y), one after the
  /// other: pair 2 s is the first half of set s, 2 s + 1 the second.
  void (*sequence)(std::uint32_t x, std::uint32_t y, std::uint32_t seed, std::uint32_t pair,
                   std::uint32_t first, std::span<std::array<double, 2>> out);
};

const KernelFunctions& float_functions();
const KernelFunctions& double_functions();
inline const KernelFunctions& functions_of(KernelKind kernel) {
  // Auto: the tests that ask have no scene, and float is what scenes of ordinary range get.
  return kernel != KernelKind::Auto && precision_of(kernel) == Precision::Double
             ? double_functions()
             : float_functions();
}

}  // namespace lightbench::stress
