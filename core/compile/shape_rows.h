#pragma once
// A shape under a transform becomes a primitive of the kernel: its kind, the numbers of its row
// (laid out as the `xxx_at` readers of core/shapes expect) and its area, all in double.

#include <glm/mat4x4.hpp>
#include <vector>

#include "core/kernel/scene_view.h"
#include "core/scene/scene.h"

namespace lightbench {

struct ShapeRow {
  PrimitiveKind kind{};
  std::vector<double> numbers;
  double area = 0;  ///< after the transform; approximate for ellipsoids and elliptic cylinders
};

/// `matrix` maps the object to render space (scale, rotation, translation; no shear before the
/// rotation). Motion is taken over the shutter. Not for meshes.
ShapeRow make_shape_row(const Shape& shape, const glm::dmat4& matrix, double shutter_open,
                        double shutter_close);

/// The twelve numbers of an affine map, row by row, as Affine reads them.
void append_affine(std::vector<double>& row, const glm::dmat4& matrix);

}  // namespace lightbench
