// The path tracer without the features in LIGHTBENCH_WITHOUT; compiled once for each of them.

#define LIGHTBENCH_LANES LIGHTBENCH_FEATURE_COST_LANES
#include "core/kernel/path_tracer.h"

namespace lightbench::LIGHTBENCH_TARGET {
extern void (*const render)(const SceneView<T>&, const Work&, FilmView, Counters&);
void (*const render)(const SceneView<T>&, const Work&, FilmView, Counters&) = render_work;
}  // namespace lightbench::LIGHTBENCH_TARGET
