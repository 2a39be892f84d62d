#define LIGHTBENCH_TARGET test_reference
#define LIGHTBENCH_LANES 1
#define LIGHTBENCH_DOUBLE
#define SUITE LightChoiceReference
#include "tests/sampling/light_choice_checks.inc"
