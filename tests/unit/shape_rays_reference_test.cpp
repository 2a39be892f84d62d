#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE ShapeRaysReference
#include "tests/unit/shape_rays.inc"
