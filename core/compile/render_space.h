#pragma once
// Render space: the scene translated and scaled so that it sits around the origin with about unit
// size. Float is most precise there, and a scene moved or scaled as a whole renders alike.

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

/// The middle of a scene from the boxes of its surfaces: the median of their centres, so that a
/// huge ground sphere does not drag it away from where the detail is.
glm::dvec3 middle_of(std::span<const Bounds> surfaces);

/// The factor that brings coordinates up to `extent` to about 1 for kernels of number type T (float
/// or double); 1 if there is none.
///
/// Float: exactly to 1. Whatever the units of the scene are, float then rounds the same numbers the
/// same way, and the picture has the same bits. With a power of two a few paths in a thousand turn
/// off between units, where they meet many curved surfaces.
/// Double: by a power of two, which rounds nothing, so that answers in scene units keep all digits.
/// Its own rounding is too fine to turn paths off.
template <class T>
double unit_scale(double extent);

/// `matrix` followed by the move to render space.
glm::dmat4 to_render_space(const RenderSpace& space, const glm::dmat4& matrix);

}  // namespace lightbench
