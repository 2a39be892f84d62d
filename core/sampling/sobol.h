#pragma once
// Owen-scrambled points, padded: every set of four dimensions is a (0,4)-sequence in base 4 of its
// own (core/sampling/quaternary.h), and each half of it, a pair of dimensions, a (0,2)-sequence in
// base 2; index order and all coordinates are scrambled by hashes of (seed, pixel, set). Burley,
// "Practical Hash-based Owen Scrambling", JCGT 9:4 (2020), with the hash constants of N. Vegdahl
// (psychopath.io, 2021-01-30). A number is a pure function of (seed, pixel, sample, dimension).

#include "core/kernel/vec.h"
#include "core/sampling/hash.h"
#include "core/sampling/quaternary.h"
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

/// Two numbers of 32 bits each.
struct Bits2 {
  Int x, y;
};
inline Vec2 unit_from_bits(Bits2 b) { return {unit_from_bits(b.x), unit_from_bits(b.y)}; }

struct Sampler {
  Int pixel_key;             ///< hash of seed and pixel
  Int reversed_index;        ///< sample index, bits reversed
  bool independent = false;  ///< hashes instead of Sobol points: plain Monte Carlo

  /// The first half of a set.
  [[nodiscard]] Bits2 first_bits(Int set) const {
    return half(set, Int(0U), [](Int index) { return Bits2{index, second_reversed(index)}; });
  }
  [[nodiscard]] Bits2 second_bits(Int set) const {
    return half(set, Int(kSecond), [](Int index) {
      return Bits2{third_reversed(index), fourth_reversed(index)};
    });
  }
  /// The second half in the lanes of `second`, the first in the others.
  [[nodiscard]] Bits2 either_bits(Int set, Mask second) const {
    return half(set, select(second, Int(kSecond), Int(0U)), [&](Int index) {
      return Bits2{select(second, third_reversed(index), index),
                   select(second, fourth_reversed(index), second_reversed(index))};
    });
  }
  [[nodiscard]] Vec2 first(Int set) const { return unit_from_bits(first_bits(set)); }
  [[nodiscard]] Vec2 second(Int set) const { return unit_from_bits(second_bits(set)); }
  [[nodiscard]] Vec2 either(Int set, Mask second) const {
    return unit_from_bits(either_bits(set, second));
  }

 private:
  static constexpr std::uint32_t kSecond = 0x7feb352dU;

  /// `generate` gives both coordinates of an index with their bits reversed; `which` tells the
  /// halves' scrambles apart.
  template <class Generate>
  Bits2 half(Int set, Int which, Generate generate) const {
    // Distinct for each set of a pixel: an odd step never repeats.
    const Int key = hash(pixel_key + set * Int(0x9e3779b9U));
    const Int key_x = which ^ Int(0x68bc21ebU), key_y = which ^ Int(0x02e5be93U);
    if (independent) {
      const Int both = hash(key ^ reversed_index);
      return {hash(both ^ key_x), hash(both ^ key_y)};
    }
    // Owen scrambling the index shuffles the order within every aligned block of 2^k samples, so
    // that sets are independent of each other while each keeps its stratification.
    const Bits2 point = generate(reverse_bits(scramble_reversed(reversed_index, key)));
    return {reverse_bits(scramble_reversed(point.x, hash(key ^ key_x))),
            reverse_bits(scramble_reversed(point.y, hash(key ^ key_y)))};
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
