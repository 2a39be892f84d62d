#pragma once
// Single lights of every shape, and the points that receive from them.

#include <memory>
#include <optional>

#include "app/stress/oracle.h"
#include "app/stress/shapes.h"
#include "core/query/lights.h"

namespace lightbench::stress {

/// One light of about unit size around the origin; lights of a mesh are its triangles.
struct LightStage {
  Kind kind = Kind::Sphere;
  Shape shape;  ///< of a mesh the box that it looks like
  std::shared_ptr<const RenderScene> scene;
};
/// Radiance 1 outward (from the front of flat ones). The scene's precision is chosen for an eye
/// `reach` away.
LightStage light_stage(Random& random, Kind kind, double reach, KernelKind kernel);

/// A point of the light's surface with its outward normal; of flat lights on the front.
struct SurfacePoint {
  glm::dvec3 p{0}, n{0};
};
SurfacePoint random_surface_point(Random& random, const LightStage& stage);

/// The point as the kernel's numbers hold it.
glm::dvec3 as_held(const RenderScene& scene, const glm::dvec3& p);

}  // namespace lightbench::stress
