#pragma once
// One path per lane.

#include "core/sampling/sobol.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// The state of the paths in flight.
struct Paths {
  Ray ray;
  Vec throughput, radiance;
  Real pdf;  ///< of the ray's direction, solid angle; 0 after the camera or a delta lobe
  // The choice of a light at the last vertex with a pdf, by which a light that the ray meets is
  // weighted. Only where points choose among lights.
  Vec chosen_from, chosen_n;
  Real choice_scale;
  Vec left;             ///< direction in which it left for glass
  Int via;              ///< mirror or lens that the ray has gone by since, kStraight for none
  Real roulette_scale;  ///< undoes the radiance scaling of refraction when judging a path's worth
  Int segments;         ///< path segments traced
  Int pixel;            ///< film index
  Int sample;
  Sampler sampler;
  Mask alive;
};

/// Of the vertex at the end of a path's last segment; the first is 0.
inline Int vertex_number(const Paths& paths) { return paths.segments - Int(1U); }

LIGHTBENCH_KERNEL_END
