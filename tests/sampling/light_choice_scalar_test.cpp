#define LIGHTBENCH_TARGET test_scalar
#define LIGHTBENCH_LANES 1
#define SUITE LightChoiceScalar
#include "tests/sampling/light_choice_checks.inc"
