#pragma once
// Objects become primitives in render space, meshes their trees, and both a top-level tree.

#include "core/compile/parts.h"

namespace lightbench {

/// Meshes of `previous` are kept where their data is the same, and the shape of its tree where it
/// still serves.
template <class T>
std::shared_ptr<const GeometryPart<T>> compile_geometry(const Scene& scene,
                                                        std::shared_ptr<const SceneReach> reach,
                                                        const GeometryPart<T>* previous);

}  // namespace lightbench
