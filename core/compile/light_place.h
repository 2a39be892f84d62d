#pragma once
// Where the lights of a scene are and how they shine, in double: what the choice between them is
// compiled from.

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "core/compile/parts.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Rec. 709
inline double luminance(const glm::dvec3& c) {
  return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// The numbers of a primitive's row, in double.
template <class T>
class Numbers {
 public:
  explicit Numbers(const T* row) : row_(row) {}
  double operator[](std::size_t i) const { return static_cast<double>(row_[i]); }
  [[nodiscard]] glm::dvec3 vec(std::size_t i) const {
    return {(*this)[i], (*this)[i + 1], (*this)[i + 2]};
  }
  /// The columns of an affine map's linear part, and its translation.
  [[nodiscard]] glm::dmat3 linear(std::size_t i) const {
    return glm::transpose(glm::dmat3(vec(i), vec(i + 4), vec(i + 8)));
  }
  [[nodiscard]] glm::dvec3 translation(std::size_t i) const {
    return {(*this)[i + 3], (*this)[i + 7], (*this)[i + 11]};
  }

 private:
  const T* row_;
};

/// Where a light is, roughly: the points center + sum of c_k spread_k, |c| <= 1 (an ellipsoid or
/// ellipse), or the hull of center + spread_k.
struct LightPlacement {
  glm::dvec3 center{0};
  glm::dvec3 normal{0};  ///< of flat lights, towards the front
  std::vector<glm::dvec3> spread;
  bool round = false;

  /// How far it reaches along w from its center.
  [[nodiscard]] double extent(const glm::dvec3& w) const;
  [[nodiscard]] double radius() const;
};

/// A light as the choice sees it.
struct Lamp {
  LightPlacement place;
  double weight = 0;  ///< emitted luminance times the area that a point sees from the front
  bool two_sided = false;
};

/// Of every light, in the order of `lights`. Slots of a mesh that hold no triangle weigh nothing.
template <class T>
std::vector<Lamp> find_lamps(const Scene& scene, const GeometryPart<T>& geometry,
                             const LightPart<T>& lights);

}  // namespace lightbench
