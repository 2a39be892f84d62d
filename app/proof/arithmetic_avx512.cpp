#define ARITHMETIC_TARGET avx512
#include "app/proof/arithmetic_target.inc"
