#pragma once
// Single lights of every shape, and the points that receive from them.

#include <memory>
#include <optional>

#include "app/stress/oracle.h"
#include "app/stress/shapes.h"
#include "core/query/lights.h"

namespace lightbench::stress {

struct LightKind {
  Kind kind;
  bool stretched = false;  ///< turned and scaled unevenly: an ellipsoid, an oblique cylinder, ...
  bool flat = false;       ///< a pyramid or box a thousandth as thick as it is wide
};
inline constexpr LightKind kLightKinds[] = {
    {Kind::Sphere},    {Kind::Sphere, true}, {Kind::Cylinder}, {Kind::Cylinder, true},
    {Kind::Pyramid},   {Kind::Box},          {Kind::Disc},     {Kind::Disc, true},
    {Kind::Rectangle}, {Kind::Triangle},     {Kind::Mesh}};
std::string name_of(const LightKind& kind);

/// One light of about unit size around the origin; lights of a mesh are its triangles.
struct LightStage {
  Kind kind = Kind::Sphere;
  Shape shape;  ///< in its own space; of a mesh the box that it looks like
  glm::dmat4 to_world{1};
  std::shared_ptr<const RenderScene> scene;
  [[nodiscard]] glm::dvec3 in_world(const glm::dvec3& p) const;
};
/// Radiance 1 outward (from the front of flat ones). The scene's precision is chosen for an eye
/// `reach` away.
LightStage light_stage(Random& random, const LightKind& kind, double reach, KernelKind kernel);

/// A point of the light's surface with its outward normal; of flat lights on the front.
struct SurfacePoint {
  glm::dvec3 p{0}, n{0};
};
SurfacePoint random_surface_point(Random& random, const LightStage& stage);

/// The point as the kernel's numbers hold it.
glm::dvec3 as_held(const RenderScene& scene, const glm::dvec3& p);

}  // namespace lightbench::stress
