// Meshes through assimp.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "core/scene/scene_io.h"
#include "tests/unit/temporary_folder.h"

namespace lightbench {
namespace {

std::string ply(int vertices, const std::string& properties, int faces, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + properties + "element face " +
         std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

const char* const kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

double signed_volume(const Mesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    volume += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) +
              p.z * (q.x * r.y - q.y * r.x);
  }
  return volume / 6;
}

TEST(MeshFile, ObjQuadsBecomeTrianglesThatShareVertices) {
  const TemporaryFolder folder;
  const auto mesh = load_mesh(folder.write("cube.obj", kCube));
  EXPECT_EQ(mesh->positions.size(), 8U);
  EXPECT_EQ(mesh->triangles.size(), 12U);
  EXPECT_TRUE(mesh->normals.empty());
  EXPECT_TRUE(mesh->uvs.empty());
  EXPECT_NEAR(signed_volume(*mesh), 1, 1e-12);  // also says that faces kept their orientation
}

TEST(MeshFile, TinyMeshesAreNotMerged) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "tiny.ply", ply(4, "", 2, "0 0 0\n1e-7 0 0\n0 1e-7 0\n1e-7 1e-7 0\n3 0 1 2\n3 1 3 2\n"));
  const auto mesh = load_mesh(file);
  EXPECT_EQ(mesh->positions.size(), 4U);
  EXPECT_EQ(mesh->triangles.size(), 2U);
  EXPECT_EQ(mesh->positions[1].x, static_cast<double>(1e-7F));
}

TEST(MeshFile, NormalsAndUvsAreKept) {
  const TemporaryFolder folder;
  const auto mesh = load_mesh(folder.write(
      "n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvt 0.25 0.75\nf 1/1/1 2/1/1 3/1/1\n"));
  ASSERT_EQ(mesh->normals.size(), 3U);
  EXPECT_EQ(mesh->normals[0], glm::dvec3(0, 0, 1));
  ASSERT_EQ(mesh->uvs.size(), 3U);
  EXPECT_EQ(mesh->uvs[0], glm::dvec2(0.25, 0.75));
}

TEST(MeshFile, UnusableNormalsAreDropped) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("n.ply", ply(3, "property float nx\nproperty float ny\nproperty float nz\n", 1,
                                "0 0 0 0 0 1\n1 0 0 0 0 0\n0 1 0 0 0 1\n3 0 1 2\n"));
  EXPECT_TRUE(load_mesh(file)->normals.empty());
}

TEST(MeshFile, PartsAreJoined) {
  const TemporaryFolder folder;
  const auto mesh = load_mesh(folder.write(
      "two.obj",
      "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no two\nv 0 0 9\nv 1 0 9\nv 0 1 9\nf 4 5 6\n"));
  EXPECT_EQ(mesh->positions.size(), 6U);
  EXPECT_EQ(mesh->triangles.size(), 2U);
}

TEST(MeshFile, NodeTransformsAreApplied) {
  const TemporaryFolder folder;
  const char* collada =
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n">
<translate>10 20 30</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  const auto mesh = load_mesh(folder.write("moved.dae", collada));
  ASSERT_EQ(mesh->positions.size(), 3U);
  EXPECT_EQ(mesh->positions[0], glm::dvec3(10, 20, 30));
}

void expect_error(const std::filesystem::path& file) {
  try {
    static_cast<void>(load_mesh(file));
    FAIL() << file;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ": cannot be read: "));
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(MeshFile, BrokenFilesAreOneLineErrors) {
  const TemporaryFolder folder;
  expect_error(folder / "none.ply");
  expect_error(folder.path());
  expect_error(folder.write("empty.ply", ""));
  expect_error(folder.write("text.ply", "hello"));
  expect_error(folder.write("text.obj", "hello"));
  expect_error(folder.write("unknown.xyzw", "hello"));
  expect_error(folder.write("points.ply", ply(3, "", 0, "0 0 0\n1 0 0\n0 1 0\n")));
  expect_error(folder.write("line.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"));
  expect_error(folder.write("index.ply", ply(3, "", 1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n")));
}

TEST(MeshFile, ATriangleWithNanIsRefusedByTheScene) {
  const TemporaryFolder folder;
  folder.write("nan.ply", ply(3, "", 1, "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n"));
  EXPECT_THROW(static_cast<void>(
                   parse_scene(R"({"lightbench": 1, "meshes": [{"name": "m", "file": "nan.ply"}]})",
                               folder.path(), "x")),
               Error);
}

TEST(MeshFile, DamagedFilesNeverCrash) {
  const TemporaryFolder folder;
  const std::string sources[] = {kCube, ply(3, "", 1, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")};
  const char* names[] = {"damaged.obj", "damaged.ply"};
  std::mt19937 engine(5);
  for (int kind = 0; kind < 2; ++kind) {
    for (int i = 0; i < 80; ++i) {
      std::string bytes = sources[kind];
      const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(engine()) % n; };
      for (std::size_t flips = 1 + pick(4); flips-- > 0;)
        bytes[pick(bytes.size())] = "0123456789 \n-+.ev#fx"[pick(20)];
      if (i % 4 == 0) bytes.resize(pick(bytes.size()));
      try {
        EXPECT_FALSE(load_mesh(folder.write(names[kind], bytes))->triangles.empty());
      } catch (const Error&) {
        // refused in words: as good as read
      }
    }
  }
}

}  // namespace
}  // namespace lightbench
