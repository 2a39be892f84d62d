#define LIGHTBENCH_TARGET reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#include "core/query/entry_points.h"
