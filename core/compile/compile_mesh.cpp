#include "core/compile/compile_mesh.h"

#include <algorithm>

#include "core/compile/render_space.h"
#include "core/parallel.h"
#include "core/scene/bounds.h"

namespace lightbench {
namespace {

/// Triangles or vertices that a thread takes at a time.
constexpr std::size_t kRun = 16384;

/// Vertices as the kernel will hold them, in the mesh's own space.
template <class T>
std::vector<glm::vec<3, T>> to_mesh_space(const MeshPart<T>& part, Team& team) {
  const std::vector<glm::dvec3>& positions = part.source->positions;
  std::vector<glm::vec<3, T>> vertices(positions.size());
  team.runs(positions.size(), kRun, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      vertices[i] = glm::vec<3, T>((positions[i] - part.center) * part.scale);
    }
  });
  return vertices;
}

/// Boxes that contain exactly these triangles.
template <class T>
std::vector<BvhBox> triangle_boxes(const Mesh& mesh, const std::vector<glm::vec<3, T>>& vertices,
                                   Team& team) {
  std::vector<BvhBox> boxes(mesh.triangles.size());
  team.runs(boxes.size(), kRun, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double lo[3], hi[3];
      const auto& t = mesh.triangles[i];
      for (int k = 0; k < 3; ++k) {
        const auto a = static_cast<double>(vertices[t[0]][k]);
        const auto b = static_cast<double>(vertices[t[1]][k]);
        const auto c = static_cast<double>(vertices[t[2]][k]);
        lo[k] = std::min({a, b, c});
        hi[k] = std::max({a, b, c});
      }
      boxes[i] = outward_box(lo, hi);
    }
  });
  return boxes;
}

}  // namespace

template <class T>
std::shared_ptr<const MeshPart<T>> compile_mesh(const std::shared_ptr<const Mesh>& mesh,
                                                unsigned threads) {
  constexpr std::size_t kLarge = 2 * kRun;  // smaller ones are done before another thread wakes
  Team team(mesh->triangles.size() > kLarge ? threads : 1);
  auto part = std::make_shared<MeshPart<T>>();
  part->source = mesh;
  const Bounds bounds = mesh_bounds(*mesh);
  part->center = bounds.center();
  const glm::dvec3 size = bounds.size();
  const double extent = std::max({size.x, size.y, size.z});
  part->scale = unit_scale<T>(extent);

  const std::vector<glm::vec<3, T>> vertices = to_mesh_space(*part, team);
  Bvh bvh = build_bvh(triangle_boxes(*mesh, vertices, team), {}, BvhLeaf::Blocks, team);
  part->nodes = std::move(bvh.nodes);
  part->slot_triangle = std::move(bvh.items);
  part->nodes.shrink_to_fit();
  part->slot_triangle.shrink_to_fit();
  part->triangle_slot.resize(mesh->triangles.size());
  part->blocks.resize(part->slot_triangle.size() / kBvhWidth);
  team.runs(part->slot_triangle.size(), kRun, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      if (part->slot_triangle[s] == Bvh::kPadding) continue;
      part->triangle_slot[part->slot_triangle[s]] = static_cast<std::uint32_t>(s);
      const auto& t = mesh->triangles[part->slot_triangle[s]];
      for (std::size_t v = 0; v < 3; ++v) {
        for (int k = 0; k < 3; ++k) {
          const auto row = 3 * v + static_cast<std::size_t>(k);
          part->blocks[s / kBvhWidth].v[row][s % kBvhWidth] = vertices[t[v]][k];
        }
      }
    }
  });
  return part;
}

template <class T>
MeshView<T> mesh_view(const MeshPart<T>& part) {
  const Mesh& source = *part.source;
  MeshView<T> view{part.nodes.data(), part.blocks.data(), part.slot_triangle.data()};
  view.triangles = source.triangles.empty() ? nullptr : source.triangles[0].data();
  view.normals = source.normals.empty() ? nullptr : &source.normals[0].x;
  view.uvs = source.uvs.empty() ? nullptr : &source.uvs[0].x;
  view.beyond_cache =
      part.nodes.size() * sizeof(BvhNode) + part.blocks.size() * sizeof(TriangleBlock<T>) >
      kCacheBytes;
  return view;
}

template <class T>
std::int64_t bytes_of(const MeshPart<T>& part) {
  const auto bytes = [](const auto& v) { return v.size() * sizeof v[0]; };
  const Mesh& source = *part.source;
  return static_cast<std::int64_t>(bytes(part.nodes) + bytes(part.blocks) +
                                   bytes(part.slot_triangle) + bytes(part.triangle_slot) +
                                   bytes(source.positions) + bytes(source.normals) +
                                   bytes(source.uvs) + bytes(source.triangles));
}

template std::shared_ptr<const MeshPart<float>> compile_mesh(const std::shared_ptr<const Mesh>&,
                                                             unsigned);
template std::shared_ptr<const MeshPart<double>> compile_mesh(const std::shared_ptr<const Mesh>&,
                                                              unsigned);
template MeshView<float> mesh_view(const MeshPart<float>&);
template MeshView<double> mesh_view(const MeshPart<double>&);
template std::int64_t bytes_of(const MeshPart<float>&);
template std::int64_t bytes_of(const MeshPart<double>&);

}  // namespace lightbench
