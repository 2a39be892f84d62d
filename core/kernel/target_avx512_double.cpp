#define LIGHTBENCH_TARGET avx512_double
#define LIGHTBENCH_LANES 8
#define LIGHTBENCH_DOUBLE
#include "core/kernel/entry_points.h"
