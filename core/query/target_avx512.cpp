#define LIGHTBENCH_TARGET avx512
#define LIGHTBENCH_LANES 16
#include "core/query/entry_points.h"
