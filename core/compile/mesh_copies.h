#pragma once
// Meshes that lie over copies of themselves: a lacquer over a body, a print over a bottle.

#include <cstdint>
#include <span>

#include "core/compile/surface_gaps.h"
#include "core/scene/scene.h"

namespace lightbench {

/// The smallest gap above `contact` and below `limit` between two mesh objects whose triangles are
/// the same list of corners (one asset twice, or a second one with its corners moved): how far the
/// farthest corner is from its copy. Infinite if there is none. O(n log n) in the objects where few
/// are neighbours; corners are compared up to the first that is beyond `limit`.
SurfaceGap smallest_copy_gap(const Scene& scene, std::span<const std::uint8_t> roles,
                             const glm::dvec3& center, double contact, double limit);

}  // namespace lightbench
