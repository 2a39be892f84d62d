#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE LightReference
#include "tests/sampling/light_checks.inc"
