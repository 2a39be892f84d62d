#define LIGHTBENCH_TARGET avx2
#define LIGHTBENCH_LANES 8
#include "tests/bench/micro/kernel_loops.inc"
