#define LIGHTBENCH_TARGET stress_float
#define LIGHTBENCH_LANES 1
#define FUNCTIONS float_functions
#include "app/stress/kernel_functions.inc"
