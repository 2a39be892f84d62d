#define LIGHTBENCH_TARGET scalar
#define LIGHTBENCH_LANES 1
#include "core/query/entry_points.h"
