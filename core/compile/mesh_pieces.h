#pragma once
// The pieces that a mesh falls into.

#include "core/scene/mesh.h"

namespace lightbench {

/// Longest side of the box of the smallest piece: of the triangles that hang together by common
/// corners. Corners at the same place count as one, since files repeat them where normals change.
/// Pieces without extent show nothing and do not count; infinite if there is no other. O(n).
double smallest_piece(const Mesh& mesh);

}  // namespace lightbench
