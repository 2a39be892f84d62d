#pragma once
// What the paths' rays meet next: a surface, a point in a medium, or nothing.

#include "core/accel/closest_hit.h"
#include "core/film/counters.h"
#include "core/kernel/paths.h"
#include "core/kernel/uses.h"
#include "core/lights/environment.h"
#include "core/media/medium.h"

LIGHTBENCH_KERNEL_BEGIN

/// The nearest surface, and where a medium scatters before it.
struct Interaction {
  NearestHit hit;
  MediumHit medium;
};

/// Traces the rays of the live paths: one segment more. `surfaces` as find_hits() has it. Out of
/// line, for it has two callers.
[[gnu::noinline]] inline Interaction intersect(const SceneView<T>& scene, Paths& paths,
                                               Counters& counters,
                                               const Surfaces& surfaces = kAllSurfaces) {
  const Mask alive = paths.alive;
  counters.rays += static_cast<std::uint64_t>(__builtin_popcount(bits(alive)));
  Interaction met{no_hit(Real(kInfinity)), {Real(kInfinity), Vec(Real(1)), Mask(false)}};
  find_hits<false>(scene, paths.ray, alive, met.hit, surfaces);
  if (uses(scene, Feature::Triangles)) refine_hits(scene, paths.ray, met.hit);
  paths.segments = select(alive, paths.segments + Int(1U), paths.segments);
  if (uses(scene, Feature::Media)) {
    met.medium =
        sample_media(scene, paths.ray, met.hit.t, paths.sampler, vertex_number(paths), alive);
  }
  return met;
}

/// Ends the paths that met nothing: they see the environment.
template <class Watch>
inline void escape(const SceneView<T>& scene, Paths& paths, const Interaction& met, Watch& watch) {
  const Mask stays = paths.alive && (met.hit.primitive != Int(kNoHit) || met.medium.scattered);
  const Mask escaped = paths.alive && !stays;
  if (uses(scene, Feature::Environment) && any(escaped)) {
    const Vec sky = environment_radiance(scene, paths.ray.d, escaped);
    if constexpr (Watch::kOn) watch.emitted(escaped, sky, Real(1));
    paths.radiance = select(escaped, paths.radiance + paths.throughput * sky, paths.radiance);
  }
  paths.alive = stays;
}

LIGHTBENCH_KERNEL_END
