#define ARITHMETIC_TARGET avx512
#include "core/arithmetic/checks.inc"
