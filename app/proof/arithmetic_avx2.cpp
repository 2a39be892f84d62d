#define ARITHMETIC_TARGET avx2
#include "app/proof/arithmetic_target.inc"
