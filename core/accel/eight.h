#pragma once
// Eight numbers, a coordinate of a node's boxes or of a block's triangles, in as many parts as the
// target needs: a part is a Real; with sixteen lanes half a register, which is faster than a whole
// one of which a half is idle.

#include "core/accel/bvh_node.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

inline constexpr int kPart = kLanes < kBvhWidth ? kLanes : kBvhWidth;  ///< numbers of a part

#if LIGHTBENCH_LANES == 16

typedef float PartLanes __attribute__((vector_size(32)));

struct PartMask {
  __mmask8 m;
};

struct Part {
  PartLanes v;
  Part() = default;
  Part(float a) : v(_mm256_set1_ps(a)) {}
  explicit Part(PartLanes a) : v(a) {}
};

inline Part operator+(Part a, Part b) { return Part(a.v + b.v); }
inline Part operator-(Part a, Part b) { return Part(a.v - b.v); }
inline Part operator*(Part a, Part b) { return Part(a.v * b.v); }
inline Part operator/(Part a, Part b) { return Part(a.v / b.v); }
inline PartMask operator<(Part a, Part b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline PartMask operator<=(Part a, Part b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline PartMask operator==(Part a, Part b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
inline PartMask operator!=(Part a, Part b) { return {_mm256_cmp_ps_mask(a.v, b.v, _CMP_NEQ_UQ)}; }
inline PartMask operator>(Part a, Part b) { return b < a; }
inline PartMask operator>=(Part a, Part b) { return b <= a; }
inline PartMask operator&&(PartMask a, PartMask b) { return {static_cast<__mmask8>(a.m & b.m)}; }
inline PartMask operator||(PartMask a, PartMask b) { return {static_cast<__mmask8>(a.m | b.m)}; }
inline PartMask operator!(PartMask a) { return {static_cast<__mmask8>(~a.m)}; }
inline Part select(PartMask m, Part a, Part b) {
  return Part(PartLanes(_mm256_mask_blend_ps(m.m, b.v, a.v)));
}
inline std::uint32_t bits(PartMask a) { return a.m; }
inline bool any(PartMask a) { return a.m != 0; }
// Like those of Real: a NaN in `a` loses.
inline Part min(Part a, Part b) { return Part(PartLanes(_mm256_min_ps(a.v, b.v))); }
inline Part max(Part a, Part b) { return Part(PartLanes(_mm256_max_ps(a.v, b.v))); }
inline Part fma(Part a, Part b, Part c) { return Part(PartLanes(_mm256_fmadd_ps(a.v, b.v, c.v))); }
inline Part load_part(const float* p) { return Part(PartLanes(_mm256_loadu_ps(p))); }
inline void store(float* p, Part a) { _mm256_storeu_ps(p, a.v); }

#else

using Part = Real;
template <class Number>
Part load_part(const Number* p) {
  return load(p);
}

#endif

LIGHTBENCH_KERNEL_END
