#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE WarpReference
#include "tests/sampling/warp_checks.inc"
