#pragma once
// Integer hashes: all randomness is a hash of where it is used, never a state.

#include "core/kernel/lanes.h"

LIGHTBENCH_KERNEL_BEGIN

/// Bijective mixer with low bias (C. Wellons' "lowbias32").
inline Int hash(Int x) {
  x ^= x >> 16;
  x *= Int(0x21f0aaadU);
  x ^= x >> 15;
  x *= Int(0xd35a2d97U);
  x ^= x >> 15;
  return x;
}

inline Int hash(Int a, Int b) {
  return hash(a ^ (hash(b) + Int(0x9e3779b9U) + (a << 6) + (a >> 2)));
}

LIGHTBENCH_KERNEL_END
