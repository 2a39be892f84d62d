#define LIGHTBENCH_TARGET scalar
#define LIGHTBENCH_LANES 1
#include "tests/bench/micro/kernel_loops.inc"
