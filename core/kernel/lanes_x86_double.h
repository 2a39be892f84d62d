#pragma once
// Double: 4 lanes on AVX2, 8 on AVX-512. The same operations as the scalar double target, so that
// the films are bit-identical: no fused multiply-add, the C library's elementary functions.
// Int lanes are 32 bits wide as everywhere, half a Real; masks are as wide as Real.

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

using T = double;
inline constexpr int kLanes = LIGHTBENCH_LANES;
typedef double RealLanes __attribute__((vector_size(8 * LIGHTBENCH_LANES)));
typedef std::uint64_t WideLanes __attribute__((vector_size(8 * LIGHTBENCH_LANES)));
typedef std::uint32_t IntLanes __attribute__((vector_size(4 * LIGHTBENCH_LANES)));

#if LIGHTBENCH_LANES == 8
#define LB_REAL_INTRINSIC(name) _mm512_##name
#define LB_INT_INTRINSIC(name) _mm256_##name
using IntRegister = __m256i;
inline IntRegister load_register(const std::uint32_t* p) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}
#else
#define LB_REAL_INTRINSIC(name) _mm256_##name
#define LB_INT_INTRINSIC(name) _mm_##name
using IntRegister = __m128i;
inline IntRegister load_register(const std::uint32_t* p) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
}
#endif

struct Mask {
#if LIGHTBENCH_LANES == 8
  __mmask8 m;
  Mask() = default;
  Mask(bool b) : m(b ? 0xff : 0) {}
  explicit Mask(__mmask8 k) : m(k) {}
#else
  WideLanes m;
  Mask() = default;
  Mask(bool b) : m(WideLanes(_mm256_set1_epi64x(b ? -1 : 0))) {}
  explicit Mask(WideLanes k) : m(k) {}
#endif
};

struct Real {
  RealLanes v;
  Real() = default;
  Real(double a) : v(LB_REAL_INTRINSIC(set1_pd)(a)) {}
  explicit Real(RealLanes a) : v(a) {}
};

struct Int {
  IntLanes v;
  Int() = default;
  Int(std::uint32_t a) : v(IntLanes(LB_INT_INTRINSIC(set1_epi32)(static_cast<int>(a)))) {}
  explicit Int(IntLanes a) : v(a) {}
};

#if LIGHTBENCH_LANES == 8
inline Mask operator<(Real a, Real b) { return Mask(_mm512_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ)); }
inline Mask operator<=(Real a, Real b) { return Mask(_mm512_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ)); }
inline Mask operator==(Real a, Real b) { return Mask(_mm512_cmp_pd_mask(a.v, b.v, _CMP_EQ_OQ)); }
inline Mask operator!=(Real a, Real b) { return Mask(_mm512_cmp_pd_mask(a.v, b.v, _CMP_NEQ_UQ)); }
inline Mask operator==(Int a, Int b) {
  return Mask(_mm256_cmpeq_epi32_mask(IntRegister(a.v), IntRegister(b.v)));
}
inline Mask operator<(Int a, Int b) {
  return Mask(_mm256_cmplt_epu32_mask(IntRegister(a.v), IntRegister(b.v)));
}
inline Mask operator&&(Mask a, Mask b) { return Mask(static_cast<__mmask8>(a.m & b.m)); }
inline Mask operator||(Mask a, Mask b) { return Mask(static_cast<__mmask8>(a.m | b.m)); }
inline Mask operator!(Mask a) { return Mask(static_cast<__mmask8>(~a.m)); }
inline Mask operator!=(Mask a, Mask b) { return Mask(static_cast<__mmask8>(a.m ^ b.m)); }
inline Real select(Mask m, Real a, Real b) {
  return Real(RealLanes(_mm512_mask_blend_pd(m.m, b.v, a.v)));
}
inline Int select(Mask m, Int a, Int b) {
  return Int(IntLanes(_mm256_mask_blend_epi32(m.m, IntRegister(b.v), IntRegister(a.v))));
}
inline std::uint32_t bits(Mask a) { return a.m; }
inline Mask mask_from_bits(std::uint32_t b) { return Mask(static_cast<__mmask8>(b)); }
inline Real floor(Real a) {
  return Real(RealLanes(_mm512_roundscale_pd(a.v, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)));
}
inline Real gather(const double* table, Int index) {
  return Real(RealLanes(_mm512_i32gather_pd(IntRegister(index.v), table, 8)));
}
/// Entry `index` (its low four bits) of a table of sixteen numbers.
inline Real look_up(const double* table, Int index) {
  return Real(RealLanes(_mm512_permutex2var_pd(_mm512_loadu_pd(table),
                                               _mm512_cvtepu32_epi64(IntRegister(index.v)),
                                               _mm512_loadu_pd(table + 8))));
}
inline Real load(const float* p) { return Real(RealLanes(_mm512_cvtps_pd(_mm256_loadu_ps(p)))); }
inline void store(std::uint32_t* p, Int a) {
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), IntRegister(a.v));
}
#else
/// Comparisons of Int widen to the masks' 64 bits, selections of Int narrow them again.
inline Mask widened(IntLanes m) { return Mask(WideLanes(_mm256_cvtepi32_epi64(IntRegister(m)))); }
inline IntRegister narrowed(Mask m) {
  return _mm256_castsi256_si128(
      _mm256_permutevar8x32_epi32(__m256i(m.m), _mm256_setr_epi32(0, 2, 4, 6, 0, 2, 4, 6)));
}
inline Mask operator<(Real a, Real b) {
  return Mask(WideLanes(_mm256_cmp_pd(a.v, b.v, _CMP_LT_OQ)));
}
inline Mask operator<=(Real a, Real b) {
  return Mask(WideLanes(_mm256_cmp_pd(a.v, b.v, _CMP_LE_OQ)));
}
inline Mask operator==(Real a, Real b) {
  return Mask(WideLanes(_mm256_cmp_pd(a.v, b.v, _CMP_EQ_OQ)));
}
inline Mask operator!=(Real a, Real b) {
  return Mask(WideLanes(_mm256_cmp_pd(a.v, b.v, _CMP_NEQ_UQ)));
}
inline Mask operator==(Int a, Int b) { return widened(IntLanes(a.v == b.v)); }
inline Mask operator<(Int a, Int b) { return widened(IntLanes(a.v < b.v)); }
inline Mask operator&&(Mask a, Mask b) { return Mask(a.m & b.m); }
inline Mask operator||(Mask a, Mask b) { return Mask(a.m | b.m); }
inline Mask operator!(Mask a) { return Mask(~a.m); }
inline Mask operator!=(Mask a, Mask b) { return Mask(a.m ^ b.m); }
inline Real select(Mask m, Real a, Real b) {
  return Real(RealLanes(_mm256_blendv_pd(b.v, a.v, __m256d(m.m))));
}
inline Int select(Mask m, Int a, Int b) {
  return Int(IntLanes(_mm_blendv_epi8(IntRegister(b.v), IntRegister(a.v), narrowed(m))));
}
inline std::uint32_t bits(Mask a) {
  return static_cast<std::uint32_t>(_mm256_movemask_pd(__m256d(a.m)));
}
inline Mask mask_from_bits(std::uint32_t b) {
  const WideLanes lane_bit = {1, 2, 4, 8};
  return Mask(WideLanes((WideLanes(_mm256_set1_epi64x(b)) & lane_bit) == lane_bit));
}
inline Real floor(Real a) { return Real(RealLanes(_mm256_floor_pd(a.v))); }
inline Real gather(const double* table, Int index) {
  return Real(RealLanes(_mm256_i32gather_pd(table, IntRegister(index.v), 8)));
}
/// Entry `index` (its low four bits) of a table of sixteen numbers.
inline Real look_up(const double* table, Int index) {
  return gather(table, Int(IntLanes(index.v & 15U)));
}
inline Real load(const float* p) { return Real(RealLanes(_mm256_cvtps_pd(_mm_loadu_ps(p)))); }
inline void store(std::uint32_t* p, Int a) {
  _mm_storeu_si128(reinterpret_cast<__m128i*>(p), IntRegister(a.v));
}
#endif

LIGHTBENCH_KERNEL_END
#include "core/kernel/lanes_operators.h"
LIGHTBENCH_KERNEL_BEGIN

inline Int gather(const std::uint32_t* table, Int index) {
  return Int(IntLanes(LB_INT_INTRINSIC(i32gather_epi32)(reinterpret_cast<const int*>(table),
                                                        IntRegister(index.v), 4)));
}
inline Int look_up(const std::uint32_t* table, Int index) {
  return gather(table, Int(IntLanes(index.v & 15U)));
}
inline Int load(const std::uint32_t* p) { return Int(IntLanes(load_register(p))); }
inline Real load(const double* p) { return Real(RealLanes(LB_REAL_INTRINSIC(loadu_pd)(p))); }
inline void store(double* p, Real a) { LB_REAL_INTRINSIC(storeu_pd)(p, a.v); }

// Ordered so that a NaN in `a` loses: both return `b` then.
inline Real min(Real a, Real b) { return Real(RealLanes(LB_REAL_INTRINSIC(min_pd)(a.v, b.v))); }
inline Real max(Real a, Real b) { return Real(RealLanes(LB_REAL_INTRINSIC(max_pd)(a.v, b.v))); }
inline Real sqrt(Real a) { return Real(RealLanes(LB_REAL_INTRINSIC(sqrt_pd)(a.v))); }
/// Two roundings, as in the scalar double target, which assumes no fused unit.
inline Real fma(Real a, Real b, Real c) { return a * b + c; }
inline constexpr std::uint64_t kSignBit = 0x8000000000000000U;
inline Real abs(Real a) { return Real(RealLanes(WideLanes(a.v) & ~kSignBit)); }
inline Real copysign(Real magnitude, Real sign) {
  return Real(RealLanes((WideLanes(magnitude.v) & ~kSignBit) | (WideLanes(sign.v) & kSignBit)));
}
inline Real to_real(Int a) {
  return Real(RealLanes(LB_REAL_INTRINSIC(cvtepi32_pd)(IntRegister(a.v))));
}
/// Truncates; |a| < 2^31.
inline Int to_int(Real a) { return Int(IntLanes(LB_REAL_INTRINSIC(cvttpd_epi32)(a.v))); }
/// The bits of the nearest float.
inline Int float_bits(Real a) { return Int(IntLanes(LB_REAL_INTRINSIC(cvtpd_ps)(a.v))); }
/// Uniform in [0,1) from 32 random bits.
inline Real unit_from_bits(Int a) {
  return (to_real(a ^ Int(0x80000000U)) + Real(2147483648.0)) * Real(0x1p-32);
}

/// Lane 0.
inline T first(Real a) { return a.v[0]; }
inline std::uint32_t first(Int a) { return a.v[0]; }

/// The set lanes take consecutive numbers from p on; the others keep `old`. Reads kLanes numbers
/// from p whatever the mask.
#if LIGHTBENCH_LANES == 8
inline Int expand(Mask m, const std::uint32_t* p, Int old) {
  return Int(IntLanes(_mm256_mask_expand_epi32(IntRegister(old.v), m.m, load_register(p))));
}
inline Real expand(Mask m, const double* p, Real old) {
  return Real(RealLanes(_mm512_mask_expand_pd(old.v, m.m, _mm512_loadu_pd(p))));
}
/// The numbers of the set lanes go to p one after the other. Writes kLanes numbers whatever the
/// mask.
inline void compress(std::uint32_t* p, Mask m, Int a) {
  store(p, Int(IntLanes(_mm256_maskz_compress_epi32(m.m, IntRegister(a.v)))));
}
inline void compress(double* p, Mask m, Real a) {
  _mm512_storeu_pd(p, _mm512_maskz_compress_pd(m.m, a.v));
}
#else
/// For each mask of four lanes: the position of each set lane among the set ones, and the two
/// 32-bit halves of the double there, a byte each.
struct ExpandTable {
  std::uint32_t positions[16];
  std::uint64_t halves[16];
  constexpr ExpandTable() : positions(), halves() {
    for (unsigned m = 0; m < 16; ++m) {
      std::uint32_t next = 0;
      for (unsigned i = 0; i < 4; ++i) {
        if ((m >> i & 1U) == 0) continue;
        positions[m] |= next << (8 * i);
        halves[m] |= std::uint64_t{2 * next + ((2 * next + 1) << 8)} << (16 * i);
        ++next;
      }
    }
  }
};
inline constexpr ExpandTable kExpandTable;
inline Int expand(Mask m, const std::uint32_t* p, Int old) {
  const __m128i positions =
      _mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(kExpandTable.positions[bits(m)])));
  const __m128 moved = _mm_permutevar_ps(_mm_castsi128_ps(load_register(p)), positions);
  return select(m, Int(IntLanes(_mm_castps_si128(moved))), old);
}
inline Real expand(Mask m, const double* p, Real old) {
  const __m256i halves =
      _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(kExpandTable.halves[bits(m)])));
  const __m256i moved =
      _mm256_permutevar8x32_epi32(_mm256_castpd_si256(_mm256_loadu_pd(p)), halves);
  return select(m, Real(RealLanes(_mm256_castsi256_pd(moved))), old);
}
/// For each mask of four lanes: the set ones, and the 32-bit halves of their doubles, a byte each.
struct CompressTable {
  std::uint32_t lanes[16];
  std::uint64_t halves[16];
  constexpr CompressTable() : lanes(), halves() {
    for (unsigned m = 0; m < 16; ++m) {
      unsigned next = 0;
      for (std::uint32_t i = 0; i < 4; ++i) {
        if ((m >> i & 1U) == 0) continue;
        lanes[m] |= i << (8 * next);
        halves[m] |= std::uint64_t{2 * i + ((2 * i + 1) << 8)} << (16 * next);
        ++next;
      }
    }
  }
};
inline constexpr CompressTable kCompressTable;
inline void compress(std::uint32_t* p, Mask m, Int a) {
  const __m128i lanes =
      _mm_cvtepu8_epi32(_mm_cvtsi32_si128(static_cast<int>(kCompressTable.lanes[bits(m)])));
  const __m128 moved = _mm_permutevar_ps(_mm_castsi128_ps(IntRegister(a.v)), lanes);
  store(p, Int(IntLanes(_mm_castps_si128(moved))));
}
inline void compress(double* p, Mask m, Real a) {
  const __m256i halves = _mm256_cvtepu8_epi32(
      _mm_cvtsi64_si128(static_cast<long long>(kCompressTable.halves[bits(m)])));
  const __m256i moved = _mm256_permutevar8x32_epi32(_mm256_castpd_si256(a.v), halves);
  _mm256_storeu_pd(p, _mm256_castsi256_pd(moved));
}
#endif

/// Half bytes by table, then bytes in reverse order.
inline Int reverse_bits(Int x) {
  const auto in_each_16 = [](__m128i row) {
#if LIGHTBENCH_LANES == 8
    return _mm256_broadcastsi128_si256(row);
#else
    return row;
#endif
  };
  const IntRegister reversed_half =
      in_each_16(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
  const IntRegister reversed_bytes =
      in_each_16(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
  const Int half_mask(0x0f0f0f0fU);
  const auto lookup = [&](Int half) {
    return Int(IntLanes(LB_INT_INTRINSIC(shuffle_epi8)(reversed_half, IntRegister(half.v))));
  };
  const Int swapped = (lookup(x & half_mask) << 4) | lookup((x >> 4) & half_mask);
  return Int(IntLanes(LB_INT_INTRINSIC(shuffle_epi8)(IntRegister(swapped.v), reversed_bytes)));
}

#undef LB_REAL_INTRINSIC
#undef LB_INT_INTRINSIC

LIGHTBENCH_KERNEL_END
