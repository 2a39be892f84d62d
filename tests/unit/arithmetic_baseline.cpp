#define ARITHMETIC_TARGET baseline
#include "tests/unit/arithmetic_checks.inc"
