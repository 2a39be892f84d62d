#pragma once
// Owen-scrambled Sobol points, padded: every pair of dimensions is a (0,2)-sequence of its own,
// with its index order and both coordinates scrambled by hashes of (seed, pixel, dimension pair).
// Burley, "Practical Hash-based Owen Scrambling", JCGT 9:4 (2020), with the hash constants of N.
// Vegdahl (psychopath.io, 2021-01-30). A number is a pure function of (seed, pixel, sample,
// dimension).

#include "core/kernel/vec.h"
#include "core/sampling/hash.h"
#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// Owen scrambling of a number given with its bits reversed (Laine-Karras style hash).
inline Int scramble_reversed(Int x, Int seed) {
  x ^= x * Int(0x3d20adeaU);
  x += seed;
  x *= (seed >> 16) | Int(1U);
  x ^= x * Int(0x05526c56U);
  x ^= x * Int(0x53a22864U);
  return x;
}

/// Second Sobol dimension of `index`, with its bits reversed: the Pascal-triangle matrix mod 2 by
/// five shifted xors (Ahmed 2024).
inline Int sobol_second_reversed(Int index) {
  Int x = index;
  x ^= x >> 16;
  x ^= (x & Int(0xff00ff00U)) >> 8;
  x ^= (x & Int(0xf0f0f0f0U)) >> 4;
  x ^= (x & Int(0xccccccccU)) >> 2;
  x ^= (x & Int(0xaaaaaaaaU)) >> 1;
  return x;
}

/// Names of the dimension pairs of a path.
namespace dimension {
inline constexpr std::uint32_t kFilter = 0;
inline constexpr std::uint32_t kLens = 1;
inline constexpr std::uint32_t kTime = 2;
inline constexpr std::uint32_t kFirstVertex = 3;
inline constexpr std::uint32_t kPerVertex = 4;
// Offsets within a vertex.
inline constexpr std::uint32_t kBsdf = 0;
inline constexpr std::uint32_t kLight = 1;
inline constexpr std::uint32_t kChoice = 2;    ///< light choice, roulette
inline constexpr std::uint32_t kDistance = 3;  ///< free flight, third dimension of a lobe
}  // namespace dimension

struct Sampler {
  Int pixel_key;             ///< hash of seed and pixel
  Int reversed_index;        ///< sample index, bits reversed
  bool independent = false;  ///< hashes instead of Sobol points: plain Monte Carlo

  /// Both numbers as 32 bits each.
  struct Bits {
    Int x, y;
  };
  [[nodiscard]] Bits pair_bits(Int dimension_pair) const {
    // Distinct for each dimension of a pixel: an odd step never repeats.
    const Int key = hash(pixel_key + dimension_pair * Int(0x9e3779b9U));
    if (independent) {
      const Int both = hash(key ^ reversed_index);
      return {hash(both ^ Int(0x68bc21ebU)), hash(both ^ Int(0x02e5be93U))};
    }
    // Owen scrambling the index shuffles the order within every aligned block of 2^k samples, so
    // that pairs are independent of each other while each keeps its stratification.
    const Int index = reverse_bits(scramble_reversed(reversed_index, key));
    // The first dimension is the index reversed; the scramble wants it reversed, which is the
    // index.
    const Int x = reverse_bits(scramble_reversed(index, hash(key ^ Int(0x68bc21ebU))));
    const Int y =
        reverse_bits(scramble_reversed(sobol_second_reversed(index), hash(key ^ Int(0x02e5be93U))));
    return {x, y};
  }
  [[nodiscard]] Vec2 pair(Int dimension_pair) const {
    const Bits b = pair_bits(dimension_pair);
    return {unit_from_bits(b.x), unit_from_bits(b.y)};
  }
};

/// Floor of n * bits / 2^32: a uniform integer below n, exact to n / 2^32.
inline Int scale_bits(Int bits, std::uint32_t n) {
  const Int low_mask(0xffffU), nl(n & 0xffffU), nh(n >> 16);
  const Int rl = bits & low_mask, rh = bits >> 16;
  const Int a = rh * nl + ((rl * nl) >> 16);
  const Int b = rl * nh + (a & low_mask);
  return rh * nh + (a >> 16) + (b >> 16);
}

LIGHTBENCH_KERNEL_END
