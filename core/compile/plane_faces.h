#pragma once
// The plane faces by which lights are sampled (core/lights/face.h): mirrors, and panes of glass.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/compile/glass_interior.h"
#include "core/compile/light_place.h"
#include "core/compile/parts.h"
#include "core/scene/scene.h"

namespace lightbench {

/// One side of a mirror's face, or of a pane the face that looks away from the lights. In render
/// space: origin + a u + b v, for (a, b) as the outline has it.
struct PlaneFace {
  glm::dvec3 n, origin, u, v;  ///< n is unit
  FaceOutline outline;
  std::uint32_t primitive;
  glm::dvec3 color;               ///< of a pane, of both refractions together
  double thickness = 0, ior = 1;  ///< of a pane
  bool crowded = false;           ///< something may reach into the glass

  /// Vectors whose products with a point's place from the origin are its a and b.
  [[nodiscard]] glm::dvec3 dual_u() const;
  [[nodiscard]] glm::dvec3 dual_v() const;
};

/// The faces of plane-sided primitives that are ideal mirrors.
template <class T>
std::vector<PlaneFace> mirror_faces(const Scene& scene, const GeometryPart<T>& geometry);

/// The faces of boxes of clear glass, of the scene's first kMaxWithImages but for hollow
/// ones, that anything is before.
template <class T>
std::vector<PlaneFace> pane_faces(const Scene& scene, const GeometryPart<T>& geometry,
                                  const ObjectBoxes& boxes);

/// Whether light of the lamp can fall on the front of a mirror, or on the back of a pane.
bool can_light(const Lamp& lamp, const PlaneFace& face);

template <class T>
void append_face(const PlaneFace& face, T offset, std::vector<T>& rows);

}  // namespace lightbench
