#pragma once
// Surfaces that lie so close over each other that float cannot tell which is in front.

#include <cstdint>
#include <limits>
#include <span>

#include "core/scene/scene.h"

namespace lightbench {

/// Shares of the scene's farthest coordinate. Below the first a gap is only looked for if float
/// could lose it: 64 of its steps, since distances to both surfaces are rounded several times.
/// Below the second surfaces touch: as close as a transform in double leaves what is meant to
/// coincide.
inline constexpr double kFloatGap = 0x1p-18;
inline constexpr double kContactGap = 0x1p-40;

struct SurfaceGap {
  double gap = std::numeric_limits<double>::infinity();  ///< scene units
  std::size_t first = 0, second = 0;                     ///< objects
};

/// The smallest gap in (kContactGap, kFloatGap) times `farthest` between two spheres with a common
/// centre or so, two parallel flat faces that overlap, or two cylinder sides with a common axis;
/// the infinite one if there is none. Of objects with a role (object_roles); meshes are not looked
/// at. O(n log n) where few surfaces are that close.
SurfaceGap smallest_gap(const Scene& scene, std::span<const std::uint8_t> roles, double farthest,
                        const glm::dvec3& center);

}  // namespace lightbench
