#pragma once
// Flat objects on the hull of the scene: those that have all else on one side of their plane, as
// the walls of a room do. No straight way between two points of the scene crosses such a plane, so
// shadow rays need not be tested against it.

#include <cstdint>
#include <vector>

#include "core/scene/bounds.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Whether each object is one, over the whole shutter. `roles` says what takes part in the scene
/// (scene_reach.h), `meshes` is what all_mesh_bounds() gives. Takes time in proportion to the flat
/// objects times all objects.
std::vector<bool> find_walls(const Scene& scene, const std::vector<std::uint8_t>& roles,
                             const std::vector<Bounds>& meshes);

}  // namespace lightbench
