// What double lanes cost against float lanes of the same width in bits, shape by shape: nanoseconds
// per camera ray of a picture that one shape fills, and per further shape that a ray is tested
// against. One thread, the least of several interleaved rounds.
//
//   bench_double_cost [ROUNDS]

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <vector>

#include "core/compile/render_scene.h"

namespace lightbench {
namespace {

constexpr int kSide = 256, kSpp = 6;
constexpr int kMore = 48;  ///< further shapes behind the first; too few for a tree

Mesh round_mesh() {
  constexpr std::uint32_t kRows = 32, kColumns = 64;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= kRows; ++i) {
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const double a = std::numbers::pi * i / kRows, b = 2 * std::numbers::pi * k / kColumns;
      mesh.positions.emplace_back(std::sin(a) * std::cos(b), std::cos(a),
                                  std::sin(a) * std::sin(b));
    }
  }
  for (std::uint32_t i = 0; i < kRows; ++i) {
    for (std::uint32_t k = 0; k < kColumns; ++k) {
      const std::uint32_t a = i * kColumns + k, b = i * kColumns + (k + 1) % kColumns;
      if (i > 0) mesh.triangles.push_back({a, b, a + kColumns});
      if (i + 1 < kRows) mesh.triangles.push_back({b, b + kColumns, a + kColumns});
    }
  }
  return mesh;
}

struct Subject {
  const char* name;
  Shape shape;
  glm::dvec3 scale{1};
};

Scene scene_of(const Subject& subject, int count) {
  Scene scene;
  scene.render.width = scene.render.height = kSide;
  scene.render.max_depth = 1;
  scene.camera.look_from = {0, 0, 4};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vfov = 10;
  scene.environment.color = glm::dvec3(1);
  scene.materials.emplace_back();
  scene.materials.back().name = "black";
  scene.materials.back().kind = MaterialKind::Emissive;
  if (std::holds_alternative<MeshShape>(subject.shape)) {
    scene.meshes.push_back({"mesh", "", std::make_shared<const Mesh>(round_mesh())});
  }
  for (int i = 0; i < count; ++i) {
    Object o;
    o.shape = subject.shape;
    o.transform.scale = subject.scale;
    o.transform.translation = {0, 0, -0.01 * i};
    o.material = 0;
    scene.objects.push_back(o);
  }
  return scene;
}

double nanoseconds(const RenderScene& scene) {
  Film film(kSide, kSide, scene.film_unit);
  Counters counters;
  const std::clock_t start = std::clock();  // of the processor: other programs do not count
  render(scene, {0, 0, kSide, kSide, 0, kSpp, 1}, film.view(), counters);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return 1e9 * seconds / static_cast<double>(counters.rays);
}

int run(int rounds) {
  const Subject subjects[] = {
      {"sphere", SphereShape{}},
      {"moving sphere", SphereShape{glm::dvec3(0), 1, {0.1, 0, 0}}},
      {"ellipsoid", SphereShape{}, {1, 1.5, 1}},
      {"cylinder", CylinderShape{{0, -1, 0}, {0, 1, 0}, 1}},
      {"elliptic cylinder", CylinderShape{{0, -1, 0}, {0, 1, 0}, 1}, {1, 1, 2}},
      {"disc", DiscShape{glm::dvec3(0), {0.1, 0.2, 1}, 2}},
      {"rectangle", RectangleShape{{-2, -2, 0}, {4, 0, 0.3}, {0, 4, 0.2}}},
      {"triangle", TriangleShape{{-3, -2, 0}, {3, -2, 0.1}, {0, 4, 0.2}}},
      {"pyramid", PyramidShape{{glm::dvec3(0, 4, 0), {-4, -3, -1}, {4, -3, -1}, {0, -1, 2}}}},
      {"box", BoxShape{glm::dvec3(-1), glm::dvec3(1)}},
      {"mesh, 3968 triangles", MeshShape{0}},
  };
  const KernelKind pairs[][2] = {{KernelKind::Avx512, KernelKind::Avx512Double},
                                 {KernelKind::Avx2, KernelKind::Avx2Double}};
  for (const auto& pair : pairs) {
    if (!kernel_supported(pair[0])) continue;
    fmt::print("| ns per ray | {0} | {1} | ratio | {0}, each more | {1}, each more | ratio |\n",
               kernel_name(pair[0]), kernel_name(pair[1]));
    fmt::print("|---|---|---|---|---|---|---|\n");
    for (const Subject& subject : subjects) {
      const bool mesh = std::holds_alternative<MeshShape>(subject.shape);
      double alone[2] = {1e30, 1e30}, many[2] = {1e30, 1e30};
      for (int round = 0; round < rounds; ++round) {
        for (int k = 0; k < 2; ++k) {
          alone[k] = std::min(alone[k], nanoseconds(*compile(scene_of(subject, 1), pair[k])));
          if (mesh) continue;
          many[k] = std::min(many[k], nanoseconds(*compile(scene_of(subject, 1 + kMore), pair[k])));
        }
      }
      fmt::print("| {} | {:.1f} | {:.1f} | {:.2f} |", subject.name, alone[0], alone[1],
                 alone[1] / alone[0]);
      if (mesh) {
        fmt::print(" | | |\n");
        continue;
      }
      const double more[2] = {(many[0] - alone[0]) / kMore, (many[1] - alone[1]) / kMore};
      fmt::print(" {:.2f} | {:.2f} | {:.2f} |\n", more[0], more[1], more[1] / more[0]);
    }
    fmt::print("\n");
  }
  return 0;
}

}  // namespace
}  // namespace lightbench

int main(int argc, char** argv) { return lightbench::run(argc > 1 ? std::atoi(argv[1]) : 7); }
