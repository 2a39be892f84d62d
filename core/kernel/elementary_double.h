#pragma once
// Elementary functions of the reference kernel: the C library's.

#include <cmath>

LIGHTBENCH_KERNEL_BEGIN

inline Real exp(Real x) { return std::exp(x); }
/// -log(1 - u), u in [0,1).
inline Real exponential(Real u) { return -std::log1p(-u); }
inline Real log(Real x) { return std::log(x); }
inline void sincos(Real x, Real& s, Real& c) {
  s = std::sin(x);
  c = std::cos(x);
}
inline Real sin(Real x) { return std::sin(x); }
inline Real cos(Real x) { return std::cos(x); }
inline Real atan2(Real y, Real x) { return std::atan2(y, x); }
inline Real acos(Real x) { return std::acos(min(max(x, Real(-1)), Real(1))); }

LIGHTBENCH_KERNEL_END
