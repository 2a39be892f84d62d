#pragma once
// Solid angles of shapes in long double, by formulas that the samplers do not use.

#include "app/stress/oracle.h"

namespace lightbench::stress {

/// Of the image under `to_world` of any shape but a mesh, from a point outside of it. Exact to
/// about 1e-12, for points nearer than a tenth of a radius to a disc or a cylinder's side less so.
Number solid_angle(const Shape& shape, const Matrix& to_world, const V& from);

}  // namespace lightbench::stress
