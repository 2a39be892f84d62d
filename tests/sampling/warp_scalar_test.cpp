#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE WarpScalar
#include "tests/sampling/warp_checks.inc"
