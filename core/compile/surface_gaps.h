#pragma once
// Surfaces that lie so close over each other that float cannot tell which is in front.

#include <cstdint>
#include <limits>
#include <span>

#include "core/scene/scene.h"

namespace lightbench {

/// Share of the distance to the farthest surface or the eye below which float loses a gap: 64 of
/// its steps, since distances to both surfaces are rounded several times.
inline constexpr double kFloatGap = 0x1p-18;

struct SurfaceGap {
  double gap = std::numeric_limits<double>::infinity();  ///< scene units
  std::size_t first = 0, second = 0;                     ///< objects
};

/// The smallest gap above `contact` and below `limit` between two spheres with a common centre or
/// so, two parallel flat faces that overlap, or two cylinder sides with a common axis; the infinite
/// one if there is none. Up to `contact` surfaces touch. Of objects with a role (object_roles);
/// meshes, and spheres and cylinder sides that a transform makes uneven, are not looked at.
/// O(n log n) where few surfaces are neighbours.
SurfaceGap smallest_gap(const Scene& scene, std::span<const std::uint8_t> roles,
                        const glm::dvec3& center, double contact, double limit);

}  // namespace lightbench
