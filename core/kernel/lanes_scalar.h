#pragma once
// One lane: the built-in types themselves.

#include <bit>
#include <cmath>
#include <cstdint>

LIGHTBENCH_KERNEL_BEGIN

#ifdef LIGHTBENCH_DOUBLE
using T = double;
#else
using T = float;
#endif
inline constexpr int kLanes = 1;
using Real = T;
using Int = std::uint32_t;
using Mask = bool;

inline Real select(Mask m, Real a, Real b) { return m ? a : b; }
inline Int select(Mask m, Int a, Int b) { return m ? a : b; }
inline Mask select(Mask m, Mask a, Mask b) { return m ? a : b; }
inline bool any(Mask m) { return m; }
inline bool none(Mask m) { return !m; }
inline std::uint32_t bits(Mask m) { return m ? 1U : 0U; }
inline Mask mask_from_bits(std::uint32_t b) { return (b & 1U) != 0; }

// Ordered so that a NaN in `a` loses: both return `b` then (the x86 instructions' rule).
inline Real min(Real a, Real b) { return a < b ? a : b; }
inline Real max(Real a, Real b) { return a > b ? a : b; }
inline Int min(Int a, Int b) { return a < b ? a : b; }
inline Real sqrt(Real a) { return std::sqrt(a); }
inline Real abs(Real a) { return std::fabs(a); }
inline Real floor(Real a) { return std::floor(a); }
inline Real copysign(Real magnitude, Real sign) { return std::copysign(magnitude, sign); }
/// a * b + c. One rounding in float; in double the processor's own (no fused unit is assumed).
#ifdef LIGHTBENCH_DOUBLE
inline Real fma(Real a, Real b, Real c) { return a * b + c; }
#else
inline Real fma(Real a, Real b, Real c) { return std::fma(a, b, c); }
#endif

inline Real to_real(Int a) { return static_cast<Real>(static_cast<std::int32_t>(a)); }
/// Truncates; |a| < 2^31.
inline Int to_int(Real a) { return static_cast<Int>(static_cast<std::int32_t>(a)); }
/// Uniform in [0,1) from 32 random bits; in float the top 24 only, so that it never rounds to 1.
#ifdef LIGHTBENCH_DOUBLE
inline Real unit_from_bits(Int a) { return static_cast<Real>(a) * 0x1p-32; }
#else
inline Real unit_from_bits(Int a) { return to_real(a >> 8) * 0x1p-24F; }
inline Int as_int(Real a) { return std::bit_cast<Int>(a); }
inline Real as_real(Int a) { return std::bit_cast<Real>(a); }
#endif

/// The bits of the nearest float.
inline Int float_bits(Real a) { return std::bit_cast<Int>(static_cast<float>(a)); }
inline Real gather(const T* table, Int index) { return table[index]; }
inline Int gather(const std::uint32_t* table, Int index) { return table[index]; }
/// Entry `index` (its low four bits) of a table of sixteen numbers.
inline Real look_up(const T* table, Int index) { return table[index & 15U]; }
inline Int look_up(const std::uint32_t* table, Int index) { return table[index & 15U]; }
inline Real load(const T* p) { return *p; }
#ifdef LIGHTBENCH_DOUBLE
inline Real load(const float* p) { return static_cast<Real>(*p); }
#endif
inline Int load(const std::uint32_t* p) { return *p; }
inline void store(T* p, Real a) { *p = a; }
inline void store(std::uint32_t* p, Int a) { *p = a; }
/// The set lanes take consecutive numbers from p on; the others keep `old`.
inline Real expand(Mask m, const T* p, Real old) { return m ? *p : old; }
inline Int expand(Mask m, const std::uint32_t* p, Int old) { return m ? *p : old; }
/// The numbers of the set lanes go to p one after the other. Writes kLanes numbers whatever the
/// mask.
inline void compress(T* p, Mask, Real a) { *p = a; }
inline void compress(std::uint32_t* p, Mask, Int a) { *p = a; }

inline Int reverse_bits(Int x) {
  x = ((x >> 1) & 0x55555555U) | ((x & 0x55555555U) << 1);
  x = ((x >> 2) & 0x33333333U) | ((x & 0x33333333U) << 2);
  x = ((x >> 4) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4);
  return __builtin_bswap32(x);
}

/// Lane 0.
inline T first(Real a) { return a; }
inline std::uint32_t first(Int a) { return a; }

LIGHTBENCH_KERNEL_END
