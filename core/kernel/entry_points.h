#pragma once
// The body of a target's translation unit.

#include "core/kernel/path_tracer.h"
#include "core/kernel/targets.h"

namespace lightbench::LIGHTBENCH_TARGET {
extern const KernelTable<T> kernel;
const KernelTable<T> kernel = {render_work, &queries};
}  // namespace lightbench::LIGHTBENCH_TARGET
