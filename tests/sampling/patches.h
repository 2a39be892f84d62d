#pragma once
// The surface of a shape as patches with coordinates (a, b) in [0,1)^2, in object space: an
// integration over surfaces that shares no code with the samplers.

#include <glm/vec3.hpp>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

struct Patch {
  enum class Kind { Sphere, Tube, Disc, Parallelogram, Triangle };
  Kind kind;
  /// Sphere: centre and three semi-axes. Tube: middle, half axis e1, radii e2 and e3. Disc: centre
  /// and radii e1, e2. The others: corner and edges e1, e2.
  glm::dvec3 origin, e1, e2, e3;
  int triangle = 0;  ///< of a mesh

  [[nodiscard]] glm::dvec3 point(double a, double b) const;
  /// Coordinates of the patch's point near p; returns the distance to it.
  double locate(const glm::dvec3& p, double& a, double& b) const;
};

/// `mesh` is what a MeshShape means.
std::vector<Patch> patches_of(const Shape& shape, const Mesh& mesh);

}  // namespace lightbench
