#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE LightScalar
#include "tests/sampling/light_checks.inc"
