#pragma once
// The compiled kernels: the same functions for each target.

#include "core/compile/render_scene.h"
#include "core/query/query_table.h"

namespace lightbench {

/// One set of entry points: render adds samples to a film; `queries` answer single questions.
template <class T>
struct KernelTable {
  void (*render)(const SceneView<T>&, const Work&, FilmView, Counters&);
  const QueryTable<T>* queries;
};

#define LIGHTBENCH_DECLARE_TARGET(name, type) \
  namespace name {                            \
  extern const KernelTable<type> kernel;      \
  extern const QueryTable<type> queries;      \
  }
#ifdef LIGHTBENCH_X86
LIGHTBENCH_DECLARE_TARGET(avx512, float)
LIGHTBENCH_DECLARE_TARGET(avx2, float)
LIGHTBENCH_DECLARE_TARGET(avx512_double, double)
LIGHTBENCH_DECLARE_TARGET(avx2_double, double)
#endif
LIGHTBENCH_DECLARE_TARGET(scalar, float)
LIGHTBENCH_DECLARE_TARGET(reference, double)
#undef LIGHTBENCH_DECLARE_TARGET

}  // namespace lightbench
