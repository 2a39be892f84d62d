#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE BvhScalar
#include "tests/unit/bvh_hits.inc"
