#include "tests/bench/micro/subjects.h"

#include <array>
#include <iterator>
#include <optional>

#include "core/compile/render_space.h"
#include "tests/bench/micro/models.h"

namespace lightbench::micro {
namespace {

constexpr std::size_t kRays = std::size_t{1} << 18;

/// The same rays in render space.
RaySet to_render(const RenderSpace& space, RaySet rays) {
  for (std::size_t i = 0; i < rays.padded(); ++i) {
    const glm::dvec3 o = space.to_render({rays.o[0][i], rays.o[1][i], rays.o[2][i]});
    for (int k = 0; k < 3; ++k) rays.o[static_cast<std::size_t>(k)][i] = static_cast<float>(o[k]);
    rays.t_max[i] = static_cast<float>(rays.t_max[i] * space.scale);
  }
  return rays;
}

Subject make(Mesh model) {
  Subject s;
  s.mesh = std::make_shared<const Mesh>(std::move(model));
  s.scene = compile(scene_of(s.mesh), KernelKind::Scalar);
  const RenderSpace& space = s.parts().geometry->space;
  s.bounces = to_render(space, bounces(*s.mesh, kRays));
  s.chords = to_render(space, chords(*s.mesh, kRays));
  s.segments = to_render(space, segments(*s.mesh, kRays));
  for (const glm::dvec3& p : s.mesh->positions) {
    const glm::dvec3 r = space.to_render(p);
    s.vertices.push_back(
        {static_cast<float>(r.x), static_cast<float>(r.y), static_cast<float>(r.z)});
  }
  return s;
}

}  // namespace

Scene scene_of(std::shared_ptr<const Mesh> mesh) {
  Scene scene;
  scene.environment.color = glm::dvec3(1);
  scene.materials.emplace_back().name = "grey";
  scene.meshes.push_back({"mesh", "", std::move(mesh)});
  Object object;
  object.shape = MeshShape{0};
  object.material = 0;
  scene.objects.push_back(object);
  return scene;
}

const Subject& subject(std::size_t i) {
  static std::array<std::optional<Subject>, std::size(kSubjects)> made;
  if (!made.at(i)) {
    const int triangles = i % 2 == 0 ? 70000 : 300000;
    made.at(i) = make(i < 2 ? bumpy_sphere(triangles) : column_hall(triangles));
  }
  return *made.at(i);
}

}  // namespace lightbench::micro
