#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE TextureScalar
#include "tests/unit/texture_checks.inc"
