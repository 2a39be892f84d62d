#pragma once
// Render space: the scene translated and scaled by a power of two so that it sits around the origin
// with about unit size. Float is most precise there, and a scene moved or scaled as a whole renders
// alike.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/scene/bounds.h"

namespace lightbench {

/// render = (scene - center) * scale
struct RenderSpace {
  glm::dvec3 center{0};
  double scale = 1;

  [[nodiscard]] glm::dvec3 to_render(const glm::dvec3& p) const { return (p - center) * scale; }
  [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& p) const { return p / scale + center; }
  bool operator==(const RenderSpace&) const = default;
};

/// From the boxes of the surfaces. The centre is the median of their centres, so that a huge ground
/// sphere does not drag it away from where the detail is.
RenderSpace choose_render_space(std::span<const Bounds> objects);

/// `matrix` followed by the move to render space.
glm::dmat4 to_render_space(const RenderSpace& space, const glm::dmat4& matrix);

}  // namespace lightbench
