#define ARITHMETIC_TARGET avx2
#include "core/arithmetic/checks.inc"
