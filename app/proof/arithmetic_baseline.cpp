#define ARITHMETIC_TARGET baseline
#include "app/proof/arithmetic_target.inc"
