#pragma once
// The way of a ray through a body of glass: refracted into it and out of it, nothing between.

#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

struct GlassWay {
  Vec p_in, p_out;  ///< where it enters and leaves
  Vec n_in, n_out;  ///< unit outward normals there
  Vec d;            ///< within
  Vec d_out;        ///< beyond
  Real t;           ///< to the glass
  Real chord;       ///< length within
  Real passing;     ///< probability of both refractions
  Mask valid;
};

/// What a way through it has to know of a body, whatever its shape.
struct GlassBody {
  Real primitive, offset;  ///< offset: bound on the error of a point on it
  Vec tint;                ///< of both refractions together
  Real crowded;            ///< above 0 where something may be inside
};

LIGHTBENCH_KERNEL_END
