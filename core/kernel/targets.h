#pragma once
// The compiled kernels: the same functions for each target, and the plain rays that queries pass.

#include "core/compile/render_scene.h"
#include "core/kernel/scene_view.h"

namespace lightbench {

/// Render-space ray (unit direction, time in [0,1] over the shutter) and its nearest surface.
struct KernelRay {
  double o[3], d[3];
  double time, t_max;
};
struct KernelHit {
  bool found = false, front = false;
  std::uint32_t primitive = 0;
  double t = 0, u = 0, v = 0;
  double p[3], ng[3], ns[3], tangent[3];
};

/// One set of entry points: render adds samples to a film, trace answers one ray, occluded asks for
/// any surface before t_max.
template <class T>
struct KernelTable {
  void (*render)(const SceneView<T>&, const Work&, FilmView, Counters&);
  KernelHit (*trace)(const SceneView<T>&, const KernelRay&);
  bool (*occluded)(const SceneView<T>&, const KernelRay&);
};

#define LIGHTBENCH_DECLARE_TARGET(name, type) \
  namespace name {                            \
  extern const KernelTable<type> kernel;      \
  }
#ifdef LIGHTBENCH_X86
LIGHTBENCH_DECLARE_TARGET(avx512, float)
LIGHTBENCH_DECLARE_TARGET(avx2, float)
#endif
LIGHTBENCH_DECLARE_TARGET(scalar, float)
LIGHTBENCH_DECLARE_TARGET(reference, double)
#undef LIGHTBENCH_DECLARE_TARGET

}  // namespace lightbench
