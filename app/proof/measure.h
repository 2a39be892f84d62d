#pragma once
// Rendering small pictures and reading means from them, without a session. All throw where a sample
// was not finite, and so left out of the film.

#include <cstdint>

#include "app/proof/statistics.h"
#include "core/compile/render_scene.h"
#include "core/film/film.h"

namespace lightbench::proof {

/// The whole picture with `spp` samples in every pixel, from sample number `first`.
Film render_film(const RenderScene& scene, int spp, int first = 0);
Film render_film(const Scene& scene, KernelKind kernel, int spp);
/// The same, cut into tiles that so many threads take in turn.
Film render_on_threads(const RenderScene& scene, int spp, int threads);

/// Mean radiance of film pixel i, in double.
glm::dvec3 pixel_mean(const Film& film, std::size_t i, int spp);

/// For pictures that should show one radiance throughout: pixels scramble their sequences
/// independently, so their means are independent estimates of it.
Estimate measure_uniform(const Scene& scene, KernelKind kernel, int spp);

/// The same with as many samples as it takes to bring the standard error of green to `error`:
/// doubled from `least_spp` to at most `most_spp` in every pixel.
struct SizedEstimate : Estimate {
  int spp = 0;  ///< taken
};
SizedEstimate measure_uniform_to(const Scene& scene, KernelKind kernel, double error, int least_spp,
                                 int most_spp);

/// Whole-picture mean over `seeds` renders with seeds of their own, for pictures that show more.
Estimate measure_by_seeds(Scene scene, KernelKind kernel, int spp, int seeds);

}  // namespace lightbench::proof
