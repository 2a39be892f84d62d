#pragma once
// The nearest hit of each lane's ray, as the tests find it: what the surface is computed from.

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// Nearest hit so far; starts at the ray's end with primitive kNoHit.
struct NearestHit {
  Real t;
  Int primitive;
  Int slot;     ///< mesh: block * 8 + column
  Real b1, b2;  ///< triangles: barycentrics of the second and third vertex
};

inline NearestHit no_hit(Real t_max) { return {t_max, Int(kNoHit), Int(0U), Real(0), Real(0)}; }

LIGHTBENCH_KERNEL_END
