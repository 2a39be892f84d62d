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

/// A direction that nothing in a scene is likely to follow: along it neighbours are few, and across
/// it is no face.
inline const glm::dvec3 kAside(1, 0.7548776662466927, 0.5698402909980532);

/// As many triangles of meshes, of all objects together, are looked at one by one: what that costs
/// an edit, the square of their number at worst, stays below 4 ms.
inline constexpr std::size_t kFewTriangles = 2048;

struct SurfaceGap {
  double gap = std::numeric_limits<double>::infinity();  ///< scene units
  std::size_t first = 0, second = 0;                     ///< objects
};

/// The smallest gap above `contact` and below `limit` between two spheres with a common centre or
/// so, two parallel flat faces that overlap, two cylinder sides with a common axis, or two copies
/// of a mesh (mesh_copies.h); the infinite one if there is none. Up to `contact` surfaces touch. Of
/// objects with a role (object_roles). Not looked at are spheres and cylinder sides that a
/// transform makes uneven, and the faces of meshes in scenes with more than kFewTriangles of them.
/// O(n log n) where few surfaces are neighbours.
SurfaceGap smallest_gap(const Scene& scene, std::span<const std::uint8_t> roles,
                        const glm::dvec3& center, double contact, double limit);

}  // namespace lightbench
