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

/// Pascal's triangle mod 2 over the digits, which are pairs of bits: the first four of five shifted
/// xors (Ahmed 2024).
inline Int pascal_digits(Int x) {
  x ^= x >> 16;
  x ^= (x >> 8) & Int(0x00ff00ffU);
  x ^= (x >> 4) & Int(0x0f0f0f0fU);
  x ^= (x >> 2) & Int(0x33333333U);
  return x;
}

/// A linear map of each digit: the bits of `keep` stay, those of `up` get the bit below them and
/// those of `down` the bit above them.
inline Int map_digits(Int x, std::uint32_t keep, std::uint32_t up, std::uint32_t down) {
  return (x & Int(keep)) ^ ((x << 1) & Int(up)) ^ ((x >> 1) & Int(down));
}

/// Dimension 1, Sobol's second: Pascal's triangle over the bits.
inline Int second_reversed(Int index) {
  const Int x = pascal_digits(index);
  return x ^ ((x >> 1) & Int(0x55555555U));
}

/// Dimension 2: entry (i, j) of the matrix is binomial(j, i) w^(j - i) with 1 + w = w^2. That is
/// digit j times w^j, Pascal's triangle, digit i times w^-i.
inline Int third_reversed(Int index) {
  const Int x = pascal_digits(map_digits(index, 0xdb6db6dbU, 0x28a28a28U, 0x14514514U));
  return map_digits(x, 0xe79e79e7U, 0x28a28a28U, 0x14514514U);
}

/// Dimension 3: the same of w^2, and the step from a digit's upper bit to its lower that dimension
/// 1 ends with: it makes this and dimension 2 good in base 2.
inline Int fourth_reversed(Int index) {
  const Int x = pascal_digits(map_digits(index, 0xe79e79e7U, 0x28a28a28U, 0x14514514U));
  return map_digits(x, 0xcf3cf3cfU, 0x28a28a28U, 0x51451451U);
}

LIGHTBENCH_KERNEL_END
