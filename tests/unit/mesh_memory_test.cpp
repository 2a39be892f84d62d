// What a compiled mesh holds: memory by triangle, and the same whatever compiled it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "core/compile/compile_mesh.h"
#include "core/compile/render_scene.h"

namespace lightbench {
namespace {

/// A sphere with normals and uvs.
std::shared_ptr<const Mesh> sphere(std::uint32_t rows) {
  Mesh mesh;
  const std::uint32_t columns = 2 * rows;
  for (std::uint32_t i = 0; i <= rows; ++i) {
    for (std::uint32_t k = 0; k <= columns; ++k) {
      const double u = double(k) / columns, v = double(i) / rows;
      const double a = std::numbers::pi * v, b = 2 * std::numbers::pi * u;
      mesh.positions.emplace_back(std::sin(a) * std::cos(b), std::cos(a),
                                  std::sin(a) * std::sin(b));
      mesh.normals.push_back(mesh.positions.back());
      mesh.uvs.emplace_back(u, v);
    }
  }
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t k = 0; k < columns; ++k) {
      const std::uint32_t p = i * (columns + 1) + k;
      mesh.triangles.push_back({p, p + 1, p + columns + 1});
      mesh.triangles.push_back({p + 1, p + columns + 2, p + columns + 1});
    }
  }
  return std::make_shared<const Mesh>(std::move(mesh));
}

TEST(MeshMemory, IsAtMost120BytesPerTriangle) {
  Scene scene;
  scene.materials.emplace_back();
  scene.meshes.push_back({"mesh", "", sphere(100)});
  Object object;
  object.shape = MeshShape{0};
  object.material = 0;
  scene.objects.push_back(object);
  const RenderStats stats = compile(scene, KernelKind::Scalar)->stats;
  EXPECT_EQ(stats.triangles, 40000);
  // The scene's own mesh, the tree, the triangles of its leaves and the maps between them.
  EXPECT_LE(static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles), 120);
  EXPECT_GT(static_cast<double>(stats.bytes) / static_cast<double>(stats.triangles), 80);
}

TEST(MeshMemory, ACompiledMeshIsTheSameForAnyNumberOfThreads) {
  const auto mesh = sphere(100);
  const auto alone = compile_mesh<float>(mesh, 1);
  for (const unsigned threads : {2U, 5U}) {
    const auto part = compile_mesh<float>(mesh, threads);
    EXPECT_EQ(part->slot_triangle, alone->slot_triangle);
    EXPECT_EQ(part->triangle_slot, alone->triangle_slot);
    ASSERT_EQ(part->blocks.size(), alone->blocks.size());
    EXPECT_EQ(std::memcmp(part->blocks.data(), alone->blocks.data(),
                          alone->blocks.size() * sizeof alone->blocks[0]),
              0);
  }
}

}  // namespace
}  // namespace lightbench
