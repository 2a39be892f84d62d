#pragma once
// What `lightbench info` says of a compiled scene: which of the kernel's stations it enters.

#include <vector>

#include "core/compile/render_scene.h"
#include "core/kernel/scene_view.h"

namespace lightbench {

template <class T>
std::vector<Feature> feature_list(const SceneView<T>& view) {
  const auto tree = view.nodes != nullptr;
  return {
      {"bvh", tree,
       tree ? "eight-wide tree over the objects" : "tiny scene: every primitive is tested"},
      {"refined hits", view.hit_quality == HitQuality::Refined,
       "closest approach of far rays to small round shapes"},
      {"triangles", view.has_triangles, "refined distance and barycentrics of their hits"},
      {"motion", view.camera.moving, "rays carry a time"},
      {"lens", view.camera.lens_radius > T(0), "defocus blur"},
      {"lights", view.samples_lights, "next-event estimation"},
      {"choice of lights", view.candidate_count > 0, "by what each would bring to the point"},
      {"light tree", view.light_nodes != nullptr, "the same for many lights, by clusters of them"},
      {"images in mirrors", view.mirror_count > 0, "lights sampled by way of plane mirrors"},
      {"environment", view.has_environment, "radiance from outside"},
      {"media", view.medium_count > 0, "free flights and transmittance"},
      {"textures", view.has_textures, "base colour lookups"},
      {"emission textures", view.has_emission_textures, "textured lights"},
      {"uv", view.needs_uv, "surface coordinates of curved shapes"},
      {"solid textures", view.to_object != nullptr, "points in object space"},
      {"lambertian", view.has_lambertian, "diffuse lobe"},
      {"mirror", view.has_mirror, "smooth metal"},
      {"fuzz", view.has_fuzz, "the books' fuzzy metal"},
      {"ggx", view.has_ggx, "rough metal"},
      {"dielectric", view.has_dielectric, "smooth glass"},
  };
}

}  // namespace lightbench
