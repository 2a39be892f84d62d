#include "app/stress/light_scenes.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>

#include "app/stress/scenes.h"
#include "core/scene/transform.h"

namespace lightbench::stress {

std::string name_of(const LightKind& kind) {
  if (kind.flat) return std::string("flat ") + name_of(kind.kind);
  if (!kind.stretched) return name_of(kind.kind);
  if (kind.kind == Kind::Sphere) return "ellipsoid";
  return std::string("elliptic ") + name_of(kind.kind);
}

glm::dvec3 LightStage::in_world(const glm::dvec3& p) const { return transform_point(to_world, p); }

LightStage light_stage(Random& random, const LightKind& kind, double reach, KernelKind kernel) {
  LightStage stage;
  stage.kind = kind.kind;
  Scene scene = empty_scene();
  scene.materials[0].kind = MaterialKind::Emissive;
  scene.materials[0].emissive = glm::dvec3(1);
  if (kind.kind == Kind::Mesh) {
    stage.shape = BoxShape{glm::dvec3(-0.5), glm::dvec3(0.5)};
    add_mesh(scene, cube_mesh(0.5));
  } else {
    Transform transform;
    if (kind.stretched) {
      transform.scale = {random.between(0.3, 1.2), random.between(0.3, 1.2),
                         random.between(0.3, 1.2)};
      transform.axis = random.direction();
      transform.degrees = random.between(0, 360);
    }
    stage.shape =
        kind.flat ? random_flat_solid(random, kind.kind) : random_shape(random, kind.kind);
    stage.to_world = object_to_world(transform);
    add_object(scene, stage.shape, transform);
  }
  scene.camera.look_from = {0, 0, reach};
  stage.scene = compile(scene, kernel);
  return stage;
}

SurfacePoint random_surface_point(Random& random, const LightStage& stage) {
  const auto in_world = [&](const glm::dvec3& p, const glm::dvec3& n) -> SurfacePoint {
    return {stage.in_world(p),
            glm::normalize(glm::inverseTranspose(glm::dmat3(stage.to_world)) * n)};
  };
  if (!is_solid(stage.kind) && stage.kind != Kind::Mesh) {
    const glm::dvec3 p = random_point(random, stage.shape);
    return in_world(p, glm::dvec3(flat_point(stage.shape, {V(p), V(0, 0, 1)}).normal));
  }
  const V inside(random_point(random, stage.shape)), d(random.direction());
  const V p = inside + solid_span(stage.shape, {inside, d}).far * d;
  return in_world(glm::dvec3(p), glm::dvec3(solid_normal(stage.shape, p)));
}

glm::dvec3 as_held(const RenderScene& scene, const glm::dvec3& p) {
  Ray ray;
  ray.origin = p;
  return as_traced(scene, ray).origin;
}

}  // namespace lightbench::stress
