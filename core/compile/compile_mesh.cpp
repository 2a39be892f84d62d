#include "core/compile/compile_mesh.h"

#include <algorithm>

#include "core/compile/render_space.h"
#include "core/scene/bounds.h"

namespace lightbench {

template <class T>
std::shared_ptr<const MeshPart<T>> compile_mesh(const std::shared_ptr<const Mesh>& mesh) {
  auto part = std::make_shared<MeshPart<T>>();
  part->source = mesh;
  const Bounds bounds = mesh_bounds(*mesh);
  part->center = bounds.center();
  const glm::dvec3 size = bounds.size();
  const double extent = std::max({size.x, size.y, size.z});
  part->scale = unit_scale<T>(extent);

  // Vertices as the kernel will hold them; the boxes contain exactly these.
  std::vector<glm::vec<3, T>> vertices(mesh->positions.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = glm::vec<3, T>((mesh->positions[i] - part->center) * part->scale);
  }
  std::vector<BvhBox> boxes(mesh->triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    double lo[3], hi[3];
    const auto& t = mesh->triangles[i];
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<double>(vertices[t[0]][k]),
                 b = static_cast<double>(vertices[t[1]][k]);
      const auto c = static_cast<double>(vertices[t[2]][k]);
      lo[k] = std::min({a, b, c});
      hi[k] = std::max({a, b, c});
    }
    boxes[i] = outward_box(lo, hi);
  }
  Bvh bvh = build_bvh(boxes, {}, BvhLeaf::Blocks);
  part->nodes = std::move(bvh.nodes);
  part->slot_triangle = std::move(bvh.items);
  const std::size_t slots = part->slot_triangle.size();
  part->triangle_slot.resize(mesh->triangles.size());
  // One more block: wide loads of the last one may read past it.
  part->blocks.resize(slots / kBvhWidth + 1);
  if (!mesh->normals.empty()) part->normals.resize(9 * slots);
  if (!mesh->uvs.empty()) part->uvs.resize(6 * slots);
  for (std::size_t s = 0; s < slots; ++s) {
    if (part->slot_triangle[s] == Bvh::kPadding) continue;
    part->triangle_slot[part->slot_triangle[s]] = static_cast<std::uint32_t>(s);
    const auto& t = mesh->triangles[part->slot_triangle[s]];
    for (std::size_t v = 0; v < 3; ++v) {
      for (int k = 0; k < 3; ++k) {
        const auto row = 3 * v + static_cast<std::size_t>(k);
        part->blocks[s / kBvhWidth].v[row][s % kBvhWidth] = vertices[t[v]][k];
        if (!mesh->normals.empty())
          part->normals[9 * s + row] = static_cast<T>(mesh->normals[t[v]][k]);
      }
      for (int k = 0; k < 2 && !mesh->uvs.empty(); ++k) {
        part->uvs[6 * s + 2 * v + static_cast<std::size_t>(k)] = static_cast<T>(mesh->uvs[t[v]][k]);
      }
    }
  }
  return part;
}

template std::shared_ptr<const MeshPart<float>> compile_mesh(const std::shared_ptr<const Mesh>&);
template std::shared_ptr<const MeshPart<double>> compile_mesh(const std::shared_ptr<const Mesh>&);

}  // namespace lightbench
