#include "core/compile/render_space.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lightbench {

RenderSpace choose_render_space(std::span<const Bounds> objects) {
  RenderSpace space;
  Bounds all;
  std::vector<glm::dvec3> centers;
  for (const Bounds& b : objects) {
    if (b.empty()) continue;
    all.add(b);
    centers.push_back(b.center());
  }
  if (centers.empty()) return space;
  for (int k = 0; k < 3; ++k) {
    const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
    std::nth_element(centers.begin(), middle, centers.end(),
                     [k](const glm::dvec3& a, const glm::dvec3& b) { return a[k] < b[k]; });
    space.center[k] = (*middle)[k];
  }
  double extent = 0;
  for (int k = 0; k < 3; ++k) {
    extent = std::max({extent, space.center[k] - all.min[k], all.max[k] - space.center[k]});
  }
  if (extent > 0 && std::isfinite(extent)) space.scale = std::ldexp(1.0, -std::ilogb(extent));
  return space;
}

glm::dmat4 to_render_space(const RenderSpace& space, const glm::dmat4& matrix) {
  glm::dmat4 r = matrix;
  for (int c = 0; c < 3; ++c) r[c] = glm::dvec4(glm::dvec3(matrix[c]) * space.scale, 0);
  r[3] = glm::dvec4(space.to_render(glm::dvec3(matrix[3])), 1);
  return r;
}

}  // namespace lightbench
