#pragma once
// A point that chooses a light to sample, and its choice.

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// What a light sampler chose: a light, and by way of which face or lens (mirrors come
/// first, then panes, then lenses), kStraight for the light itself. pmf is 0 where nothing can be
/// chosen. `rest` is what the choice left of the number that made it, stretched to [0,1): where on
/// the light the sample is. So the samples of one light, a stripe of the points of a pair of
/// dimensions, keep their stratification (Shirley, Wang, Zimmerman 1996).
struct LightChoice {
  Int light, via;
  Real pmf, rest;
};

/// Distance between the numbers that unit_from_bits() gives.
inline constexpr T kUnitSpacing = T(sizeof(T) == sizeof(float) ? 0x1p-24 : 0x1p-32);

/// Of a number that fell into a part of length `share`, `rest` from where that begins. `fill`, even
/// between 0 and the distance of such numbers, is what is between them: a small part holds few.
inline Real stretched(Real rest, Real share, Real fill) {
  const Real u = (rest + fill) / select(share > Real(0), share, Real(1));
  return clamp(u, Real(0), Real(T(1) - kEpsilon));
}

/// The point that chooses; n is 0 in a medium, which looks all around. `time` is where lenses are.
struct Chooser {
  Vec p, n;
  Real time = Real(0);
};

/// As tables have it: -1 for straight.
inline std::uint32_t via_of(T number) {
  return number < T(0) ? kStraight : static_cast<std::uint32_t>(number);
}
/// Through a box of glass, or a sphere.
inline Mask is_pane(const SceneView<T>& scene, Int via) {
  return via >= Int(scene.mirror_count) && via < Int(scene.face_count);
}
inline Mask is_lens(const SceneView<T>& scene, Int via) {
  return via != Int(kStraight) && via >= Int(scene.face_count);
}

inline Mask looks_all_around(const Chooser& at) { return !(length_squared(at.n) > Real(0)); }

/// Height over the horizon of a ball of radius r whose centre is at `height`: the mean of the
/// clipped heights within it. `quarter` = 1 / (4 r).
inline Real clipped_height(Real height, Real r, Real quarter) {
  const Real above = clamp(height + r, Real(0), r + r);
  return fma(above * above, quarter, max(height - r, Real(0)));
}

/// What each of several lights or clusters would bring to the point, and the sum of all.
struct Contributions {
  Real of[kMaxLightCandidates];
  Real total;
};

/// What was picked brings `value`; what stands before it brings `before`.
struct Picked {
  Real value, before;
};
/// Picks one of the first `count` in proportion to what they bring, by u in [0,1): calls
/// f(i, lanes) for every i, the last call for a lane is with what it picked. Nothing is picked, and
/// the value is 0, where all bring nothing.
template <class F>
Picked pick(const Contributions& c, Real u, std::uint32_t count, F f) {
  const Real wanted = u * c.total;
  Real begin(0);
  Picked picked{Real(0), Real(0)};
  for (std::uint32_t i = 0; i < count; ++i) {
    // The last of those that begin before the wanted place.
    const Mask m = c.of[i] > Real(0) && wanted >= begin;
    picked.before = select(m, begin, picked.before);
    picked.value = select(m, c.of[i], picked.value);
    begin += c.of[i];
    f(i, m);
  }
  return picked;
}

LIGHTBENCH_KERNEL_END
