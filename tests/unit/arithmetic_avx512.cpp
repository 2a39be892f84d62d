#define ARITHMETIC_TARGET avx512
#include "tests/unit/arithmetic_checks.inc"
