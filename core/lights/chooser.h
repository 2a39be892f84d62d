#pragma once
// A point that chooses a light to sample, and its choice.

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// What a light sampler chose; `mirror` is kNoMirror for the light itself. pmf is 0 where nothing
/// can be chosen.
struct LightChoice {
  Int light, mirror;
  Real pmf;
};

/// The point that chooses; n is 0 in a medium, which looks all around.
struct Chooser {
  Vec p, n;
};

/// Height over the point's horizon of a ball of radius r at d, `distance` away: the mean of the
/// clipped heights within it. In a medium everything counts in full.
inline Real clipped_height(const Chooser& at, Vec d, Real r, Real distance) {
  const Real s = dot(at.n, d);
  const Real above = clamp(s + r, Real(0), r + r);
  const Real height = fma(above * above, T(0.25) / r, max(s - r, Real(0)));
  return select(length_squared(at.n) > Real(0), height, distance);
}

LIGHTBENCH_KERNEL_END
