#define LIGHTBENCH_TARGET reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#include "core/kernel/entry_points.h"
