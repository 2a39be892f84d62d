#pragma once
// What `lightbench info` says of a compiled scene: which of the kernel's features it has.

#include <vector>

#include "core/compile/render_scene.h"
#include "core/kernel/features.h"

namespace lightbench {

template <class T>
std::vector<FeatureUse> feature_list(const SceneView<T>& view) {
  const auto use = [&](const char* name, Feature feature, const char* note) {
    return FeatureUse{name, has(view, feature), note};
  };
  std::uint32_t walls = 0;
  for (unsigned k = 0; k < kPrimitiveKinds; ++k)
    walls += view.kind_begin[k + 1] - view.occluders_end[k];
  return {
      use("bvh", Feature::Tree,
          has(view, Feature::Tree) ? "eight-wide tree over the objects"
                                   : "tiny scene: every primitive is tested"),
      {"walls", walls > 0, "surfaces on the scene's hull, which no shadow ray is tested against"},
      use("refined hits", Feature::RefinedHits,
          "closest approach of far rays to small round shapes"),
      use("triangles", Feature::Triangles, "refined distance and barycentrics of their hits"),
      use("meshes", Feature::Meshes, "trees of triangles in spaces of their own"),
      use("ellipsoids", Feature::Ellipsoids, "spheres and cylinders scaled unevenly"),
      use("motion", Feature::Motion, "rays carry a time"),
      use("lens", Feature::Lens, "defocus blur"),
      use("emission", Feature::Emission, "surfaces that shine"),
      use("lights", Feature::Lights, "next-event estimation"),
      use("choice of lights", Feature::ChoiceOfLights, "by what each would bring to the point"),
      use("light tree", Feature::LightTree, "the same for many lights, by clusters of them"),
      use("images in mirrors", Feature::ImagesInMirrors, "lights sampled by way of plane mirrors"),
      use("images in panes", Feature::ImagesInPanes, "lights sampled by way of glass boxes"),
      use("images in glass", Feature::ImagesInGlass, "lights sampled by way of glass spheres"),
      use("environment", Feature::Environment, "radiance from outside"),
      use("media", Feature::Media, "free flights and transmittance"),
      use("textures", Feature::Textures, "base colour lookups"),
      use("emission textures", Feature::EmissionTextures, "textured lights"),
      use("uv", Feature::Coordinates, "surface coordinates of curved shapes"),
      use("solid textures", Feature::SolidTextures, "points in object space"),
      use("lambertian", Feature::Lambertian, "diffuse lobe"),
      use("mirror", Feature::Mirror, "smooth metal"),
      use("fuzz", Feature::Fuzz, "the books' fuzzy metal"),
      use("ggx", Feature::Ggx, "rough metal"),
      use("dielectric", Feature::Dielectric, "smooth glass"),
  };
}

}  // namespace lightbench
