#include "core/compile/render_space.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace lightbench {

glm::dvec3 middle_of(std::span<const Bounds> surfaces) {
  glm::dvec3 middle(0);
  std::vector<glm::dvec3> centers;
  for (const Bounds& b : surfaces) {
    if (!b.empty()) centers.push_back(b.center());
  }
  if (centers.empty()) return middle;
  for (int k = 0; k < 3; ++k) {
    const auto at = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
    std::nth_element(centers.begin(), at, centers.end(),
                     [k](const glm::dvec3& a, const glm::dvec3& b) { return a[k] < b[k]; });
    middle[k] = (*at)[k];
  }
  return middle;
}

template <class T>
double unit_scale(double extent) {
  if (!(extent > 0) || !std::isfinite(extent) || !std::isfinite(1 / extent)) return 1;
  return std::is_same_v<T, float> ? 1 / extent : std::ldexp(1.0, -std::ilogb(extent));
}
template double unit_scale<float>(double);
template double unit_scale<double>(double);

glm::dmat4 to_render_space(const RenderSpace& space, const glm::dmat4& matrix) {
  glm::dmat4 r = matrix;
  for (int c = 0; c < 3; ++c) r[c] = glm::dvec4(glm::dvec3(matrix[c]) * space.scale, 0);
  r[3] = glm::dvec4(space.to_render(glm::dvec3(matrix[3])), 1);
  return r;
}

}  // namespace lightbench
