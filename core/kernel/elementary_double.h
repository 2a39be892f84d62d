#pragma once
// Elementary functions of the double kernels: the C library's, lane by lane, so that every width
// gives the same bits.

#include <cmath>

LIGHTBENCH_KERNEL_BEGIN

template <class F>
Real for_each_lane(Real x, F f) {
  alignas(64) T lanes[kLanes];
  store(lanes, x);
  for (T& lane : lanes) lane = f(lane);
  return load(lanes);
}

inline Real exp(Real x) {
  return for_each_lane(x, [](T a) { return std::exp(a); });
}
/// -log(1 - u), u in [0,1).
inline Real exponential(Real u) {
  return for_each_lane(u, [](T a) { return -std::log1p(-a); });
}
inline Real log(Real x) {
  return for_each_lane(x, [](T a) { return std::log(a); });
}
inline Real sin(Real x) {
  return for_each_lane(x, [](T a) { return std::sin(a); });
}
inline Real cos(Real x) {
  return for_each_lane(x, [](T a) { return std::cos(a); });
}
inline void sincos(Real x, Real& s, Real& c) {
  s = sin(x);
  c = cos(x);
}
inline void sincos_octant(Real x, Real& s, Real& c) { sincos(x, s, c); }
inline Real acos(Real x) {
  return for_each_lane(min(max(x, Real(-1)), Real(1)), [](T a) { return std::acos(a); });
}
inline Real atan2(Real y, Real x) {
  alignas(64) T ys[kLanes], xs[kLanes];
  store(ys, y);
  store(xs, x);
  for (int i = 0; i < kLanes; ++i) ys[i] = std::atan2(ys[i], xs[i]);
  return load(ys);
}

LIGHTBENCH_KERNEL_END
