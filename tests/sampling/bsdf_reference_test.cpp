#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE BsdfReference
#include "tests/sampling/bsdf_checks.inc"
