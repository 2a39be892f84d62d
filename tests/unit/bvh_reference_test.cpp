#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE BvhReference
#include "tests/unit/bvh_hits.inc"
