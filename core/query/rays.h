#pragma once
// Rays put to a compiled scene: the nearest surface, whether anything is in the way, and how a ray
// leaves a surface. The very tests, roundings and rules of the path tracer, in all its lanes at
// once.
//
// Points, directions and distances are in scene units, double. Kernels compute in render space, in
// float or double: what they are given is rounded to that first (as_traced() tells to what).

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "core/compile/render_scene.h"

namespace lightbench {

/// The surface that a ray starts on, which it must not meet again at its origin: a flat object or a
/// triangle is never hit by it, a solid (sphere, cylinder, pyramid, box) not at all by a ray that
/// leaves to the outside and only at its exit by one that goes inside.
struct Departure {
  int object = kNone;    ///< index into Scene::objects; kNone for a free ray
  int triangle = kNone;  ///< index into Mesh::triangles; of a mesh only
  bool inside = false;   ///< to the side that the geometric normal points away from
};

struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, -1};  ///< any length but 0: distances are in units of it
  double t_max = 1e300;
  double time = 0;   ///< clamped to the camera's shutter
  double t_min = 0;  ///< surfaces up to here are ignored, as if the ray started there
  Departure from{};
  /// Added to `origin`: what is left of a point that double cannot hold in scene units, because the
  /// scene lies far from 0. spawn() sets it, so that no precision is lost on the way.
  glm::dvec3 origin_remainder{0};
};

struct Hit {
  int object = kNone;              ///< index into Scene::objects
  double t = 0;                    ///< in lengths of the ray's direction
  glm::dvec3 position{0};          ///< on the surface
  glm::dvec3 geometric_normal{0};  ///< unit, outward (the shape's front)
  glm::dvec3 shading_normal{0};    ///< unit; the geometric one unless a mesh has normals
  glm::dvec3 tangent{0};           ///< unit direction of growing u
  double u = 0, v = 0;
  bool front = false;                ///< seen from outside
  int triangle = kNone;              ///< index into Mesh::triangles; of a mesh only
  glm::dvec3 position_remainder{0};  ///< see Ray::origin_remainder
};

/// Nearest surface of each ray in (t_min, t_max); invisible boundaries of media are no surfaces.
/// `hits` must be as long as `rays`. Many rays at once are several times faster than one by one.
void trace(const RenderScene& scene, std::span<const Ray> rays, std::span<std::optional<Hit>> hits);
std::optional<Hit> trace(const RenderScene& scene, const Ray& ray);

/// 1 where any surface lies in (t_min, t_max) of the ray, else 0. `blocked` must be as long as
/// `rays`.
void occluded(const RenderScene& scene, std::span<const Ray> rays, std::span<std::uint8_t> blocked);
bool occluded(const RenderScene& scene, const Ray& ray);

/// The ray with which a path of the path tracer would leave `hit` in this direction: from the
/// origin that it would take on the direction's side of the surface, remembering what it left.
Ray spawn(const RenderScene& scene, const Hit& hit, const glm::dvec3& direction, double time = 0);

/// The ray that the kernel sees: origin, unit direction, time and ends rounded to its number type.
Ray as_traced(const RenderScene& scene, const Ray& ray);

/// The ray through point (x, y) of the picture in pixels, through the centre of the lens, mid
/// shutter.
Ray camera_ray(const Scene& scene, double x, double y);

}  // namespace lightbench
