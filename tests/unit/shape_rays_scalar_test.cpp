#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE ShapeRaysScalar
#include "tests/unit/shape_rays.inc"
