#define LIGHTBENCH_TARGET scalar
#define LIGHTBENCH_LANES 1
#include "core/kernel/entry_points.h"
