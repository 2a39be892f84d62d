#define LIGHTBENCH_TARGET avx2_double
#define LIGHTBENCH_LANES 4
#define LIGHTBENCH_DOUBLE
#include "core/query/entry_points.h"
