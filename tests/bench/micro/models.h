#pragma once
// Meshes to measure with, made by formula: no file, no licence, any number of triangles.

#include "core/scene/mesh.h"

namespace lightbench::micro {

/// A closed unit sphere with waves in its surface, of about this many triangles.
Mesh bumpy_sphere(int triangles);

/// A hall of fluted columns between tessellated floor, ceiling and walls, seen from inside, of
/// about this many triangles; within [-2, 2] x [-0.5, 0.5] x [-1, 1].
Mesh column_hall(int triangles);

}  // namespace lightbench::micro
