#pragma once
// Questions about materials: value, density and samples of their BSDFs, as the path tracer uses
// them.

#include <glm/vec3.hpp>
#include <span>

#include "core/compile/render_scene.h"

namespace lightbench {

/// A material at a surface point. Textures count as white: `base_color` is the material's own.
/// Directions are unit (they are normalised) and point away from the surface.
struct BsdfQuery {
  int material = kNone;        ///< index into Scene::materials
  glm::dvec3 normal{0, 0, 1};  ///< outward; says which side of a dielectric is inside
  glm::dvec3 wo{0, 0, 1};      ///< towards the viewer: the direction that the path came from
  glm::dvec3 wi{0, 0, 1};      ///< towards the light; ignored when sampling
  double u = 0, v = 0;         ///< [0,1), pick wi; of glass, u reflection or refraction
  double w = 0;                ///< [0,1), picks the radius of fuzz
};

/// Radiance, importance and density are per solid angle (1/sr). Delta lobes (mirrors, glass) have
/// no value and no density but in their samples.
struct BsdfValue {
  glm::dvec3 value{0};  ///< f |cos(wi, normal)|
  double pdf = 0;       ///< with which sampling picks wi
};

struct BsdfSample {
  bool valid = false;    ///< false: the path ends (absorbed)
  bool delta = false;    ///< of a delta lobe: pdf is 0 and means nothing
  glm::dvec3 wi{0};      ///< unit
  glm::dvec3 weight{0};  ///< f |cos| / pdf; of a delta lobe with its probability divided out
  double pdf = 0;
};

/// Outputs must be as long as `queries`.
void eval_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
               std::span<BsdfValue> values);
void sample_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
                 std::span<BsdfSample> samples);

}  // namespace lightbench
