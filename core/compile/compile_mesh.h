#pragma once
// A mesh asset becomes blocks of triangles under an eight-wide tree.

#include "core/compile/parts.h"

namespace lightbench {

/// `threads` 0: the processor's. The result is the same for any number.
template <class T>
std::shared_ptr<const MeshPart<T>> compile_mesh(const std::shared_ptr<const Mesh>& mesh,
                                                unsigned threads = 0);

/// Points into the part and its source.
template <class T>
MeshView<T> mesh_view(const MeshPart<T>& part);

/// Of the part and its source.
template <class T>
std::int64_t bytes_of(const MeshPart<T>& part);

}  // namespace lightbench
