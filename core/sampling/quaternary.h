#pragma once
// Generator matrices of a (0,4)-sequence in base 4: of any aligned block of 4^k points, one is in
// each box of volume 4^-k whose sides are powers of 1/4. Pascal's triangle over the four elements
// of GF(4), one for each dimension (Niederreiter, "Point sets and sequences with small
// discrepancy", 1987; Ahmed et al., "SZ Sequences", 2024). Dimensions 0 and 1 are Sobol's first
// two; 2 and 3 are, like them, a (0,2)-sequence in base 2 as well. All functions take an index and
// give the coordinate with its bits reversed, the index's lowest bit being the most significant;
// dimension 0 is the index itself.

#include "core/kernel/lanes.h"

LIGHTBENCH_KERNEL_BEGIN

/// Every digit (pair of bits) times w, where 1 + w = w^2.
inline Int times_w(Int x) {
  return ((x ^ (x << 1)) & Int(0xaaaaaaaaU)) ^ ((x >> 1) & Int(0x55555555U));
}
/// Every digit times w^2.
inline Int times_w2(Int x) {
  return ((x << 1) & Int(0xaaaaaaaaU)) ^ ((x ^ (x >> 1)) & Int(0x55555555U));
}

/// Dimension 1: the Pascal-triangle matrix mod 2 by five shifted xors (Ahmed 2024).
inline Int second_reversed(Int index) {
  Int x = index;
  x ^= x >> 16;
  x ^= (x & Int(0xff00ff00U)) >> 8;
  x ^= (x & Int(0xf0f0f0f0U)) >> 4;
  x ^= (x & Int(0xccccccccU)) >> 2;
  x ^= (x & Int(0xaaaaaaaaU)) >> 1;
  return x;
}

/// Dimension 2: entry (i, j) of the matrix is binomial(j, i) w^(j - i).
inline Int third_reversed(Int index) {
  Int x = index;
  x ^= times_w2(x >> 16);
  x ^= times_w((x & Int(0xff00ff00U)) >> 8);
  x ^= times_w2((x & Int(0xf0f0f0f0U)) >> 4);
  x ^= times_w((x & Int(0xccccccccU)) >> 2);
  return x;
}

/// Dimension 3: the same of w^2. The last step is what makes it and dimension 2 good in base 2.
inline Int fourth_reversed(Int index) {
  Int x = index;
  x ^= times_w(x >> 16);
  x ^= times_w2((x & Int(0xff00ff00U)) >> 8);
  x ^= times_w((x & Int(0xf0f0f0f0U)) >> 4);
  x ^= times_w2((x & Int(0xccccccccU)) >> 2);
  x ^= (x & Int(0xaaaaaaaaU)) >> 1;
  return x;
}

LIGHTBENCH_KERNEL_END
