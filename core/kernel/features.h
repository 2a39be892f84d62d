#pragma once
// What a scene may lack. The kernel enters the code of a feature only where the scene has it;
// `lightbench info` lists them.

#include "core/kernel/scene_view.h"

namespace lightbench {

enum class Feature : std::uint32_t {
  Tree,
  RefinedHits,
  Triangles,
  Meshes,
  Ellipsoids,
  Motion,
  Lens,
  Lights,
  ChoiceOfLights,
  LightTree,
  ImagesInMirrors,
  ImagesInPanes,
  ImagesInGlass,
  Environment,
  Media,
  Textures,
  EmissionTextures,
  Coordinates,
  SolidTextures,
  Emission,
  Lambertian,
  Mirror,
  Fuzz,
  Ggx,
  Dielectric,
};

template <class T>
bool has_kind(const SceneView<T>& scene, PrimitiveKind kind) {
  const auto k = static_cast<unsigned>(kind);
  return scene.kind_begin[k] < scene.kind_begin[k + 1];
}

template <class T>
bool has(const SceneView<T>& scene, Feature feature) {
  switch (feature) {
    case Feature::Tree:
      return scene.nodes != nullptr;
    case Feature::RefinedHits:
      return scene.hit_quality == HitQuality::Refined;
    case Feature::Triangles:
      return scene.has_triangles;
    case Feature::Meshes:
      return has_kind(scene, PrimitiveKind::Mesh);
    case Feature::Ellipsoids:
      return has_kind(scene, PrimitiveKind::Ellipsoid) ||
             has_kind(scene, PrimitiveKind::EllipticCylinder);
    case Feature::Motion:
      return scene.camera.moving;
    case Feature::Lens:
      return scene.camera.lens_radius > T(0);
    case Feature::Lights:
      return scene.samples_lights;
    case Feature::ChoiceOfLights:
      return scene.candidate_count > 0;
    case Feature::LightTree:
      return scene.light_nodes != nullptr;
    case Feature::ImagesInMirrors:
      return scene.mirror_count > 0;
    case Feature::ImagesInPanes:
      return scene.face_count > scene.mirror_count;
    case Feature::ImagesInGlass:
      return scene.lens_count > 0;
    case Feature::Environment:
      return scene.has_environment;
    case Feature::Media:
      return scene.medium_count > 0;
    case Feature::Textures:
      return scene.has_textures;
    case Feature::EmissionTextures:
      return scene.has_emission_textures;
    case Feature::Coordinates:
      return scene.needs_uv;
    case Feature::SolidTextures:
      return scene.to_object != nullptr;
    case Feature::Emission:
      return scene.has_emission;
    case Feature::Lambertian:
      return scene.has_lambertian;
    case Feature::Mirror:
      return scene.has_mirror;
    case Feature::Fuzz:
      return scene.has_fuzz;
    case Feature::Ggx:
      return scene.has_ggx;
    case Feature::Dielectric:
      return scene.has_dielectric;
  }
  return false;
}

}  // namespace lightbench
