#define ARITHMETIC_TARGET baseline
#include "core/arithmetic/checks.inc"
