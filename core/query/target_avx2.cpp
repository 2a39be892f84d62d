#define LIGHTBENCH_TARGET avx2
#define LIGHTBENCH_LANES 8
#include "core/query/entry_points.h"
