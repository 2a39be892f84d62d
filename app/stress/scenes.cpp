#include "app/stress/scenes.h"

#include <fmt/format.h>

namespace lightbench::stress {

Scene empty_scene() {
  Scene scene;
  scene.render.width = scene.render.height = 1;
  scene.camera.look_from = {0, 0, 0};
  scene.camera.look_at = {0, 0, -1};
  scene.materials.emplace_back();
  scene.materials.back().name = "white";
  return scene;
}

Object& add_object(Scene& scene, const Shape& shape, const Transform& transform) {
  Object object;
  object.name = fmt::format("object {}", scene.objects.size());
  object.shape = shape;
  object.transform = transform;
  object.material = 0;
  return scene.objects.emplace_back(object);
}

Object& add_mesh(Scene& scene, Mesh mesh, const Transform& transform) {
  MeshAsset asset;
  asset.name = fmt::format("mesh {}", scene.meshes.size());
  asset.data = std::make_shared<const Mesh>(std::move(mesh));
  scene.meshes.push_back(asset);
  return add_object(scene, MeshShape{static_cast<int>(scene.meshes.size()) - 1}, transform);
}

std::shared_ptr<const RenderScene> compile_alone(const Shape& shape, const glm::dvec3& eye,
                                                 KernelKind kernel) {
  Scene scene = empty_scene();
  add_object(scene, shape);
  scene.camera.look_from = eye;
  scene.camera.look_at = eye + glm::dvec3(0, 0, -1);
  return compile(scene, kernel);
}

std::vector<std::optional<Hit>> trace_all(const RenderScene& scene, std::span<const Ray> rays) {
  std::vector<std::optional<Hit>> hits(rays.size());
  trace(scene, rays, hits);
  return hits;
}

double rounding_of(const RenderScene& scene) {
  return precision_of(scene.kernel) == Precision::Double ? 0x1p-53 : 0x1p-24;
}

}  // namespace lightbench::stress
