#define LIGHTBENCH_TARGET avx512
#define LIGHTBENCH_LANES 16
#include "tests/bench/micro/kernel_loops.inc"
