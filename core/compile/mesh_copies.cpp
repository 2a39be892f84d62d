#include "core/compile/mesh_copies.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <utility>
#include <variant>
#include <vector>

#include "core/scene/transform.h"

namespace lightbench {
namespace {

using glm::dvec3;

struct Copy {
  std::size_t object;
  const Mesh* mesh;
  glm::dmat4 map;
  double place;  ///< of the first corner, along kAside
};

std::vector<Copy> collect(const Scene& scene, std::span<const std::uint8_t> roles,
                          const dvec3& center) {
  std::vector<Copy> copies;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const auto* shape = std::get_if<MeshShape>(&scene.objects[i].shape);
    if (roles[i] == 0 || shape == nullptr) continue;
    const Mesh* mesh = scene.meshes[static_cast<std::size_t>(shape->mesh)].data.get();
    if (mesh == nullptr || mesh->positions.empty()) continue;
    const glm::dmat4 map = object_to_world(scene.objects[i].transform);
    const dvec3 first = transform_point(map, mesh->positions[0]);
    copies.push_back({i, mesh, map, dot(first - center, kAside)});
  }
  std::sort(copies.begin(), copies.end(), [](const Copy& a, const Copy& b) {
    return std::pair(a.mesh->positions.size(), a.place) <
           std::pair(b.mesh->positions.size(), b.place);
  });
  return copies;
}

/// The farthest that a corner of b is from the same one of a, as far as that is below `limit`.
double gap_of(const Copy& a, const Copy& b, double limit) {
  const auto& from = a.mesh->positions;
  const auto& to = b.mesh->positions;
  if (a.mesh != b.mesh && a.mesh->triangles != b.mesh->triangles) return limit;
  double gap = 0;
  for (std::size_t i = 0; i < from.size() && gap < limit; ++i) {
    gap = std::max(gap,
                   glm::distance(transform_point(a.map, from[i]), transform_point(b.map, to[i])));
  }
  return gap;
}

}  // namespace

SurfaceGap smallest_copy_gap(const Scene& scene, std::span<const std::uint8_t> roles,
                             const dvec3& center, double contact, double limit) {
  const std::vector<Copy> copies = collect(scene, roles, center);
  SurfaceGap found;
  found.gap = limit;
  const double reach = length(kAside);
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const std::size_t corners = copies[i].mesh->positions.size();
    for (std::size_t k = i + 1; k < copies.size() && copies[k].mesh->positions.size() == corners &&
                                copies[k].place - copies[i].place < reach * found.gap;
         ++k) {
      const double gap = gap_of(copies[i], copies[k], found.gap);
      if (gap > contact && gap < found.gap) found = {gap, copies[i].object, copies[k].object};
    }
  }
  return found.gap < limit ? found : SurfaceGap();
}

}  // namespace lightbench
