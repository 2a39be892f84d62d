#pragma once
// Gradient noise on the integer lattice (Perlin 1985), with quintic fade; gradients come from a
// hash.

#include "core/kernel/vec.h"
#include "core/sampling/hash.h"
#include "core/sampling/warp.h"

LIGHTBENCH_KERNEL_BEGIN

/// Dot product of the offset w with the lattice point's gradient, a uniform unit vector.
inline Real lattice_gradient(Int ix, Int iy, Int iz, Int seed, Vec w) {
  const Int h = hash(ix + hash(iy + hash(iz + hash(seed))));
  const Real z = to_real(h & Int(0xffffU)) * T(1.0 / 32768) - T(1 - 1.0 / 65536);
  const Real phi = to_real(h >> 16) * (kTwoPi / 65536);
  Real s, c;
  sincos(phi, s, c);
  const Real r = safe_sqrt(Real(1) - z * z);
  return dot(Vec{r * c, r * s, z}, w);
}

inline Real fade(Real t) { return t * t * t * fma(t, fma(t, Real(6), Real(-15)), Real(10)); }
inline Real lerp(Real t, Real a, Real b) { return fma(t, b - a, a); }

/// Smooth noise in about [-1,1], zero at lattice points. |p| < 2^30.
inline Real perlin_noise(Vec p, Int seed) {
  const Vec base{floor(p.x), floor(p.y), floor(p.z)};
  const Vec f = p - base;
  const Int ix = to_int(base.x), iy = to_int(base.y), iz = to_int(base.z);
  Real corner[8];
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t dx = k & 1U, dy = (k >> 1) & 1U, dz = k >> 2;
    const Vec w =
        f - Vec{Real(static_cast<T>(dx)), Real(static_cast<T>(dy)), Real(static_cast<T>(dz))};
    corner[k] = lattice_gradient(ix + Int(dx), iy + Int(dy), iz + Int(dz), seed, w);
  }
  const Real u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const Real low = lerp(v, lerp(u, corner[0], corner[1]), lerp(u, corner[2], corner[3]));
  const Real high = lerp(v, lerp(u, corner[4], corner[5]), lerp(u, corner[6], corner[7]));
  return lerp(w, low, high);
}

/// |sum of octaves|, each twice the frequency and half the weight of the one before (the books'
/// turbulence).
inline Real turbulence(Vec p, int octaves, Int seed) {
  Real sum(0), weight(1);
  for (int i = 0; i < octaves; ++i) {
    sum = fma(weight, perlin_noise(p, seed), sum);
    weight = weight * T(0.5);
    p = p * Real(2);
  }
  return abs(sum);
}

LIGHTBENCH_KERNEL_END
