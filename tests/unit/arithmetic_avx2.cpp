#define ARITHMETIC_TARGET avx2
#include "tests/unit/arithmetic_checks.inc"
