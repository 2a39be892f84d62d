#pragma once
// Float: 8 lanes on AVX2, 16 on AVX-512: thin structs over the compiler's vector extensions, with
// intrinsics only where the language has no operator. AVX-512 masks live in k-registers.

// g++ 12 warns of its own header's deliberately undefined registers (GCC PR 105593).
#ifndef __clang__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <immintrin.h>
#ifndef __clang__
#pragma GCC diagnostic pop
#endif

#include <cstdint>

LIGHTBENCH_KERNEL_BEGIN

using T = float;
inline constexpr int kLanes = LIGHTBENCH_LANES;
typedef float RealLanes __attribute__((vector_size(4 * LIGHTBENCH_LANES)));
typedef std::uint32_t IntLanes __attribute__((vector_size(4 * LIGHTBENCH_LANES)));
typedef std::int32_t SignedLanes __attribute__((vector_size(4 * LIGHTBENCH_LANES)));

#if LIGHTBENCH_LANES == 16
#define LB_INTRINSIC(name) _mm512_##name
using IntRegister = __m512i;
#else
#define LB_INTRINSIC(name) _mm256_##name
using IntRegister = __m256i;
#endif

inline RealLanes broadcast(float a) { return LB_INTRINSIC(set1_ps)(a); }
inline IntLanes broadcast(std::uint32_t a) {
  return IntLanes(LB_INTRINSIC(set1_epi32)(static_cast<int>(a)));
}

struct Mask {
#if LIGHTBENCH_LANES == 16
  __mmask16 m;
  Mask() = default;
  Mask(bool b) : m(b ? 0xffff : 0) {}
  explicit Mask(__mmask16 k) : m(k) {}
#else
  SignedLanes m;
  Mask() = default;
  Mask(bool b) : m(SignedLanes(_mm256_set1_epi32(b ? -1 : 0))) {}
  explicit Mask(SignedLanes k) : m(k) {}
#endif
};

struct Real {
  RealLanes v;
  Real() = default;
  Real(float a) : v(broadcast(a)) {}
  explicit Real(RealLanes a) : v(a) {}
};

struct Int {
  IntLanes v;
  Int() = default;
  Int(std::uint32_t a) : v(broadcast(a)) {}
  explicit Int(IntLanes a) : v(a) {}
};

#if LIGHTBENCH_LANES == 16
inline Mask operator<(Real a, Real b) { return Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)); }
inline Mask operator<=(Real a, Real b) { return Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)); }
inline Mask operator==(Real a, Real b) { return Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)); }
inline Mask operator!=(Real a, Real b) { return Mask(_mm512_cmp_ps_mask(a.v, b.v, _CMP_NEQ_UQ)); }
inline Mask operator==(Int a, Int b) {
  return Mask(_mm512_cmpeq_epi32_mask(IntRegister(a.v), IntRegister(b.v)));
}
inline Mask operator<(Int a, Int b) {
  return Mask(_mm512_cmplt_epu32_mask(IntRegister(a.v), IntRegister(b.v)));
}
inline Mask operator&&(Mask a, Mask b) { return Mask(static_cast<__mmask16>(a.m & b.m)); }
inline Mask operator||(Mask a, Mask b) { return Mask(static_cast<__mmask16>(a.m | b.m)); }
inline Mask operator!(Mask a) { return Mask(static_cast<__mmask16>(~a.m)); }
inline Mask operator!=(Mask a, Mask b) { return Mask(static_cast<__mmask16>(a.m ^ b.m)); }
inline Real select(Mask m, Real a, Real b) {
  return Real(RealLanes(_mm512_mask_blend_ps(m.m, b.v, a.v)));
}
inline Int select(Mask m, Int a, Int b) {
  return Int(IntLanes(_mm512_mask_blend_epi32(m.m, IntRegister(b.v), IntRegister(a.v))));
}
inline std::uint32_t bits(Mask a) { return a.m; }
inline Mask mask_from_bits(std::uint32_t b) { return Mask(static_cast<__mmask16>(b)); }
inline Real floor(Real a) {
  return Real(RealLanes(_mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)));
}
inline Real gather(const float* table, Int index) {
  return Real(RealLanes(_mm512_i32gather_ps(IntRegister(index.v), table, 4)));
}
inline Int gather(const std::uint32_t* table, Int index) {
  return Int(IntLanes(_mm512_i32gather_epi32(IntRegister(index.v), table, 4)));
}
/// Entry `index` (its low four bits) of a table of sixteen numbers.
inline Real look_up(const float* table, Int index) {
  return Real(
      RealLanes(_mm512_permutexvar_ps(IntRegister(index.v), __m512(_mm512_loadu_ps(table)))));
}
inline Int look_up(const std::uint32_t* table, Int index) {
  return Int(IntLanes(_mm512_permutexvar_epi32(IntRegister(index.v), _mm512_loadu_si512(table))));
}
inline Int load(const std::uint32_t* p) { return Int(IntLanes(_mm512_loadu_si512(p))); }
inline void store(std::uint32_t* p, Int a) { _mm512_storeu_si512(p, IntRegister(a.v)); }
#else
inline Mask operator<(Real a, Real b) {
  return Mask(SignedLanes(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}
inline Mask operator<=(Real a, Real b) {
  return Mask(SignedLanes(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}
inline Mask operator==(Real a, Real b) {
  return Mask(SignedLanes(_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)));
}
inline Mask operator!=(Real a, Real b) {
  return Mask(SignedLanes(_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)));
}
inline Mask operator==(Int a, Int b) { return Mask(SignedLanes(a.v == b.v)); }
inline Mask operator<(Int a, Int b) { return Mask(SignedLanes(a.v < b.v)); }
inline Mask operator&&(Mask a, Mask b) { return Mask(a.m & b.m); }
inline Mask operator||(Mask a, Mask b) { return Mask(a.m | b.m); }
inline Mask operator!(Mask a) { return Mask(~a.m); }
inline Mask operator!=(Mask a, Mask b) { return Mask(a.m ^ b.m); }
inline Real select(Mask m, Real a, Real b) {
  return Real(RealLanes(_mm256_blendv_ps(b.v, a.v, __m256(m.m))));
}
inline Int select(Mask m, Int a, Int b) {
  return Int(IntLanes(_mm256_blendv_epi8(IntRegister(b.v), IntRegister(a.v), IntRegister(m.m))));
}
inline std::uint32_t bits(Mask a) {
  return static_cast<std::uint32_t>(_mm256_movemask_ps(__m256(a.m)));
}
inline Mask mask_from_bits(std::uint32_t b) {
  const SignedLanes lane_bit = {1, 2, 4, 8, 16, 32, 64, 128};
  return Mask(SignedLanes((SignedLanes(broadcast(b)) & lane_bit) == lane_bit));
}
inline Real floor(Real a) { return Real(RealLanes(_mm256_floor_ps(a.v))); }
inline Real gather(const float* table, Int index) {
  return Real(RealLanes(_mm256_i32gather_ps(table, IntRegister(index.v), 4)));
}
inline Int gather(const std::uint32_t* table, Int index) {
  return Int(IntLanes(
      _mm256_i32gather_epi32(reinterpret_cast<const int*>(table), IntRegister(index.v), 4)));
}
/// Entry `index` (its low four bits) of a table of sixteen numbers.
inline Real look_up(const float* table, Int index) {
  const auto i = IntRegister(index.v);
  const __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), i);
  const __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(table + 8), i);
  return Real(
      RealLanes(_mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32(i, 28)))));
}
inline Int look_up(const std::uint32_t* table, Int index) {
  const auto* bits = reinterpret_cast<const float*>(table);
  return Int(IntLanes(_mm256_castps_si256(look_up(bits, index).v)));
}
inline Int load(const std::uint32_t* p) {
  return Int(IntLanes(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(p))));
}
inline void store(std::uint32_t* p, Int a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), IntRegister(a.v));
}
#endif

LIGHTBENCH_KERNEL_END
#include "core/kernel/lanes_operators.h"
LIGHTBENCH_KERNEL_BEGIN

// Ordered so that a NaN in `a` loses: both return `b` then.
inline Real min(Real a, Real b) { return Real(RealLanes(LB_INTRINSIC(min_ps)(a.v, b.v))); }
inline Real max(Real a, Real b) { return Real(RealLanes(LB_INTRINSIC(max_ps)(a.v, b.v))); }
inline Real sqrt(Real a) { return Real(RealLanes(LB_INTRINSIC(sqrt_ps)(a.v))); }
inline Real fma(Real a, Real b, Real c) {
  return Real(RealLanes(LB_INTRINSIC(fmadd_ps)(a.v, b.v, c.v)));
}
inline Int as_int(Real a) { return Int(IntLanes(a.v)); }
inline Real as_real(Int a) { return Real(RealLanes(a.v)); }
/// The bits of the nearest float.
inline Int float_bits(Real a) { return as_int(a); }
inline Real abs(Real a) { return as_real(as_int(a) & Int(0x7fffffffU)); }
inline Real copysign(Real magnitude, Real sign) {
  return as_real((as_int(magnitude) & Int(0x7fffffffU)) | (as_int(sign) & Int(0x80000000U)));
}
inline Real to_real(Int a) { return Real(RealLanes(LB_INTRINSIC(cvtepi32_ps)(IntRegister(a.v)))); }
/// Truncates; |a| < 2^31.
inline Int to_int(Real a) { return Int(IntLanes(LB_INTRINSIC(cvttps_epi32)(a.v))); }
/// Uniform in [0,1) from 32 random bits; the top 24 only, so that it never rounds to 1.
inline Real unit_from_bits(Int a) { return to_real(a >> 8) * 0x1p-24F; }
inline Real load(const float* p) { return Real(RealLanes(LB_INTRINSIC(loadu_ps)(p))); }
inline void store(float* p, Real a) { LB_INTRINSIC(storeu_ps)(p, a.v); }

/// Lane 0.
inline T first(Real a) { return a.v[0]; }
inline std::uint32_t first(Int a) { return a.v[0]; }

/// The set lanes take consecutive numbers from p on; the others keep `old`. Reads kLanes numbers
/// from p whatever the mask.
#if LIGHTBENCH_LANES == 16
inline Int expand(Mask m, const std::uint32_t* p, Int old) {
  return Int(IntLanes(_mm512_mask_expand_epi32(IntRegister(old.v), m.m, _mm512_loadu_si512(p))));
}
/// The numbers of the set lanes go to p one after the other. Writes kLanes numbers whatever the
/// mask.
inline void compress(std::uint32_t* p, Mask m, Int a) {
  _mm512_storeu_si512(p, _mm512_maskz_compress_epi32(m.m, IntRegister(a.v)));
}
#else
/// For each mask of eight lanes, the position of each set lane among the set ones, a byte each.
struct ExpandTable {
  std::uint64_t positions[256];
  constexpr ExpandTable() : positions() {
    for (unsigned m = 0; m < 256; ++m) {
      std::uint64_t next = 0;
      for (unsigned i = 0; i < 8; ++i) {
        if ((m >> i & 1U) != 0) positions[m] |= next++ << (8 * i);
      }
    }
  }
};
inline constexpr ExpandTable kExpandTable;
inline Int expand(Mask m, const std::uint32_t* p, Int old) {
  const __m256i positions = _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<long long>(kExpandTable.positions[bits(m)])));
  return select(m, Int(IntLanes(_mm256_permutevar8x32_epi32(IntRegister(load(p).v), positions))),
                old);
}
/// For each mask of eight lanes, the set ones, a byte each.
struct CompressTable {
  std::uint64_t lanes[256];
  constexpr CompressTable() : lanes() {
    for (unsigned m = 0; m < 256; ++m) {
      unsigned next = 0;
      for (std::uint64_t i = 0; i < 8; ++i) {
        if ((m >> i & 1U) != 0) lanes[m] |= i << (8 * next++);
      }
    }
  }
};
inline constexpr CompressTable kCompressTable;
inline void compress(std::uint32_t* p, Mask m, Int a) {
  const __m256i lanes = _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<long long>(kCompressTable.lanes[bits(m)])));
  store(p, Int(IntLanes(_mm256_permutevar8x32_epi32(IntRegister(a.v), lanes))));
}
#endif
inline Real expand(Mask m, const float* p, Real old) {
  return as_real(expand(m, reinterpret_cast<const std::uint32_t*>(p), as_int(old)));
}
inline void compress(float* p, Mask m, Real a) {
  compress(reinterpret_cast<std::uint32_t*>(p), m, as_int(a));
}

/// Half bytes by table, then bytes in reverse order.
inline Int reverse_bits(Int x) {
  const auto in_each_16 = [](__m128i row) {
#if LIGHTBENCH_LANES == 16
    return _mm512_broadcast_i32x4(row);
#else
    return _mm256_broadcastsi128_si256(row);
#endif
  };
  const IntRegister reversed_half =
      in_each_16(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const IntRegister reversed_bytes =
      in_each_16(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const Int half_mask(0x0f0f0f0fU);
  const auto lookup = [&](Int half) {
    return Int(IntLanes(LB_INTRINSIC(shuffle_epi8)(reversed_half, IntRegister(half.v))));
  };
  const Int swapped = (lookup(x & half_mask) << 4) | lookup((x >> 4) & half_mask);
  return Int(IntLanes(LB_INTRINSIC(shuffle_epi8)(IntRegister(swapped.v), reversed_bytes)));
}

#undef LB_INTRINSIC

LIGHTBENCH_KERNEL_END
