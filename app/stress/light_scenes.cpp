#include "app/stress/light_scenes.h"

#include <glm/geometric.hpp>

#include "app/stress/scenes.h"

namespace lightbench::stress {

LightStage light_stage(Random& random, Kind kind, double reach, KernelKind kernel) {
  LightStage stage;
  stage.kind = kind;
  Scene scene = empty_scene();
  scene.materials[0].kind = MaterialKind::Emissive;
  scene.materials[0].emissive = glm::dvec3(1);
  if (kind == Kind::Mesh) {
    stage.shape = BoxShape{glm::dvec3(-0.5), glm::dvec3(0.5)};
    add_mesh(scene, cube_mesh(0.5));
  } else {
    stage.shape = random_shape(random, kind);
    add_object(scene, stage.shape);
  }
  scene.camera.look_from = {0, 0, reach};
  stage.scene = compile(scene, kernel);
  return stage;
}

SurfacePoint random_surface_point(Random& random, const LightStage& stage) {
  if (!is_solid(stage.kind) && stage.kind != Kind::Mesh) {
    const glm::dvec3 p = random_point(random, stage.shape);
    return {p, glm::dvec3(flat_point(stage.shape, {V(p), V(0, 0, 1)}).normal)};
  }
  const V inside(random_point(random, stage.shape)), d(random.direction());
  const V p = inside + solid_span(stage.shape, {inside, d}).far * d;
  return {glm::dvec3(p), glm::dvec3(solid_normal(stage.shape, p))};
}

glm::dvec3 as_held(const RenderScene& scene, const glm::dvec3& p) {
  Ray ray;
  ray.origin = p;
  return as_traced(scene, ray).origin;
}

}  // namespace lightbench::stress
