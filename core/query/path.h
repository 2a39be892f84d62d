#pragma once
// One sample of the picture, written down vertex by vertex: where it went, what it met, what each
// light sample and each emitter added, and why it ended. Traced by the path tracer's own code; the
// sum is the sample that rendering adds to the film, to the last bit.

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/film/counters.h"
#include "core/film/film.h"
#include "core/kernel/path_end.h"
#include "core/query/lights.h"
#include "core/query/materials.h"

namespace lightbench {

/// Emission met by the path's own ray.
struct MetEmission {
  glm::dvec3 radiance{0};
  double weight = 1;  ///< against light sampling (power heuristic)
};

/// Next-event estimation at a vertex.
struct LightTry {
  LightPoint point;
  int via = kNone;       ///< mirror or glass by way of which it was sampled, kNone: straight
  glm::dvec3 value{0};   ///< BSDF times |cos| (or phase function) towards the light
  double value_pdf = 0;  ///< with which the BSDF would have sampled that direction
  double weight = 0;     ///< against BSDF sampling (power heuristic)
  bool visible = false;
  int blocker = kNone;  ///< object in the way, if one is; index into Scene::objects
  glm::dvec3 added{0};  ///< to the sample's radiance
};

/// A segment of the path and what happens at its end. Scene units.
struct PathVertex {
  glm::dvec3 origin{0}, direction{0};  ///< of the segment; the direction is unit
  double time = 0;
  glm::dvec3 throughput{1};  ///< with which it starts

  bool in_medium = false;
  int object = kNone;    ///< index into Scene::objects; kNone in a medium and outside the scene
  int triangle = kNone;  ///< of a mesh
  double distance = 0;
  glm::dvec3 position{0};
  glm::dvec3 geometric_normal{0};  ///< unit, outward
  glm::dvec3 shading_normal{0};    ///< unit, on the side that the path comes from
  bool front = false;              ///< it comes from outside
  glm::dvec3 base_color{0};        ///< with textures; of a medium its albedo

  std::optional<MetEmission> emission;
  std::optional<LightTry> light;
  std::optional<BsdfSample> scattered;
  double survival = 1;  ///< of Russian roulette

  glm::dvec3 radiance{0};      ///< of the sample so far
  std::optional<PathEnd> end;  ///< of the last vertex
};

struct PathRecord {
  std::vector<PathVertex> vertices;
  glm::dvec3 radiance{0};
  FilmPixel film;              ///< what the sample adds to its pixel, in the film's steps
  std::optional<Fault> fault;  ///< why it is dropped instead
};

/// Throws Error{Usage} if the pixel lies outside the picture. The scene's crop does not matter.
PathRecord trace_path(const RenderScene& scene, const SampleName& name);

}  // namespace lightbench
