#pragma once
// The kernel's inner functions in loops of their own, one table per target: what the benchmarks
// time. Scenes are compiled; rays are in render space.

#include <span>

#include "core/film/film.h"
#include "core/kernel/scene_view.h"
#include "tests/bench/micro/rays.h"

namespace lightbench::micro {

struct Answer {
  float t;
  std::uint32_t primitive, slot;  ///< kNoHit where nothing was hit
};

template <class T>
struct KernelLoops {
  /// Nearest hits, all lanes at once as the path tracer asks; `answers` is as long as the padded
  /// rays.
  void (*closest)(const SceneView<T>&, const RaySet&, std::span<Answer> answers);
  /// Any hit before t_max: `primitive` tells whether there is one, the rest is unset.
  void (*any)(const SceneView<T>&, const RaySet&, std::span<Answer> answers);
  /// All rays against primitive 0 alone, which is no mesh; how many hit it.
  std::size_t (*shape)(const SceneView<T>&, const RaySet&);
  // `count` lanes' work each, a multiple of 16; they return a sum so that nothing is left out.
  double (*sampler)(std::size_t count);                           ///< one pair of dimensions
  double (*sample_bsdf)(const SceneView<T>&, std::size_t count);  ///< of material 0
  double (*eval_bsdf)(const SceneView<T>&, std::size_t count);
  void (*film)(const SceneView<T>&, FilmView,
               std::size_t count);  ///< samples added, pixel by pixel
};

#define LIGHTBENCH_DECLARE_LOOPS(name, type) \
  namespace name {                           \
  extern const KernelLoops<type> loops;      \
  }
#ifdef LIGHTBENCH_X86
LIGHTBENCH_DECLARE_LOOPS(avx512, float)
LIGHTBENCH_DECLARE_LOOPS(avx2, float)
#endif
LIGHTBENCH_DECLARE_LOOPS(scalar, float)
#undef LIGHTBENCH_DECLARE_LOOPS

}  // namespace lightbench::micro
