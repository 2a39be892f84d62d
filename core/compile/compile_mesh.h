#pragma once
// A mesh asset becomes blocks of triangles under an eight-wide tree.

#include "core/compile/parts.h"

namespace lightbench {

template <class T>
std::shared_ptr<const MeshPart<T>> compile_mesh(const std::shared_ptr<const Mesh>& mesh);

}  // namespace lightbench
