#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE BsdfScalar
#include "tests/sampling/bsdf_checks.inc"
