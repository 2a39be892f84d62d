#pragma once
// Questions about light sampling: what the path tracer's next-event estimation would do at a point.
//
// A light is an emitter that the sampler can choose: an object that emits, or one triangle of a
// mesh that does. Densities are those of the samplers themselves, in solid angle (1/sr) at the
// point.

#include <glm/vec3.hpp>
#include <span>

#include "core/compile/render_scene.h"

namespace lightbench {

/// Which object a light is.
struct LightSource {
  int object = kNone;    ///< index into Scene::objects
  int triangle = kNone;  ///< index into Mesh::triangles; of a mesh only
  double selection = 0;  ///< share of the lights' power; 0 for filled-up places
};
/// Lights are numbered [0, light_count).
int light_count(const RenderScene& scene);
LightSource light_source(const RenderScene& scene, int light);

/// Asks for a sample of a light. Random numbers are in [0,1) and rounded to the kernel's type,
/// where they stay below 1.
struct LightQuery {
  glm::dvec3 point{0};  ///< scene units
  double u = 0, v = 0;  ///< pick the direction
  double choice = 0;    ///< picks the light, unless `light` names it
  int light = kNone;
  double time = 0;       ///< clamped to the camera's shutter
  glm::dvec3 normal{0};  ///< unit, of the surface there; 0 looks all around, as in a medium
};

/// Asks with which density a direction would be sampled.
struct LightDirection {
  glm::dvec3 point{0};             ///< scene units
  glm::dvec3 direction{0, 0, -1};  ///< any length but 0
  int light = kNone;     ///< this light alone, whatever is in the way; kNone: the one that is seen
  double time = 0;       ///< clamped to the camera's shutter
  glm::dvec3 normal{0};  ///< as in LightQuery
};

/// A point of a light, seen from the point asked about. Where !valid nothing else is meant, and no
/// light comes from there.
struct LightPoint {
  bool valid = false;
  int light = kNone;
  glm::dvec3 direction{0};  ///< unit
  double distance = 0;      ///< scene units
  glm::dvec3 normal{0};     ///< unit, outward from the light
  double pdf = 0;           ///< 1/sr, of this direction once the light is chosen
  double selection = 0;  ///< probability that the point chooses the light, not an image of it in a
                         ///< mirror; the sampler's density is the product
  glm::dvec3 radiance{0};  ///< that the light sends to the point if nothing is in the way
};

/// What the sampler picks. `points` must be as long as `queries`; the scene must have lights.
/// Nothing is said about occluders.
void sample_lights(const RenderScene& scene, std::span<const LightQuery> queries,
                   std::span<LightPoint> points);

/// The density with which the path tracer weights a direction that some other sampler chose. Valid
/// where the direction meets the light (with kNone: where the nearest surface is a light). `points`
/// must be as long as `queries`.
void pdf_lights(const RenderScene& scene, std::span<const LightDirection> queries,
                std::span<LightPoint> points);

}  // namespace lightbench
