#pragma once
// Objects become primitives in render space, meshes their trees, and both a top-level tree.

#include "core/compile/parts.h"

namespace lightbench {

/// Below this many primitives (and without meshes) a loop over all of them beats a tree: with
/// sixteen lanes up to about 300 spheres or 120 cylinders, with eight 150 or 70. The same for all
/// kernels, so that their films agree.
inline constexpr std::uint32_t kTinyScene = 96;

/// Meshes of `previous` are kept where their data is the same, and the shape of its tree where it
/// still serves.
template <class T>
std::shared_ptr<const GeometryPart<T>> compile_geometry(const Scene& scene,
                                                        std::shared_ptr<const SceneReach> reach,
                                                        const GeometryPart<T>* previous);

}  // namespace lightbench
