#define LIGHTBENCH_TARGET stress_double
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define FUNCTIONS double_functions
#include "app/stress/kernel_functions.inc"
