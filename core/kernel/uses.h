#pragma once
// The question that stands before a feature's code.

#include <initializer_list>

#include "core/kernel/features.h"
#include "core/kernel/lanes.h"

LIGHTBENCH_KERNEL_BEGIN

/// Only bench_feature_cost compiles kernels that lack features, to see what asking for them costs.
#ifdef LIGHTBENCH_WITHOUT
constexpr bool compiled(Feature feature) {
  for (const Feature missing : std::initializer_list<Feature>{LIGHTBENCH_WITHOUT}) {
    if (feature == missing) return false;
  }
  return true;
}
#else
constexpr bool compiled(Feature) { return true; }
#endif

/// Always inlined, with the feature by name: what remains is the one comparison in has().
[[gnu::always_inline]] inline bool uses(const SceneView<T>& scene, Feature feature) {
  return compiled(feature) && has(scene, feature);
}

inline HitQuality hit_quality(const SceneView<T>& scene) {
  return uses(scene, Feature::RefinedHits) ? HitQuality::Refined : HitQuality::Plain;
}

LIGHTBENCH_KERNEL_END
