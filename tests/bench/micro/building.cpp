// What stands between a mesh and its first ray: the tree over boxes, and the whole compilation. An
// item is a triangle; time is the clock's, on one thread and on all.

#include <benchmark/benchmark.h>

#include <algorithm>

#include "core/accel/bvh.h"
#include "core/compile/compile_mesh.h"
#include "core/compile/render_scene.h"
#include "core/parallel.h"
#include "tests/bench/micro/models.h"
#include "tests/bench/micro/subjects.h"

namespace lightbench::micro {
namespace {

std::vector<BvhBox> boxes_of(const Mesh& mesh) {
  std::vector<BvhBox> boxes;
  boxes.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    double lo[3], hi[3];
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] =
          std::minmax({mesh.positions[t[0]][k], mesh.positions[t[1]][k], mesh.positions[t[2]][k]});
      lo[k] = low;
      hi[k] = high;
    }
    boxes.push_back(outward_box(lo, hi));
  }
  return boxes;
}

void add_line(const std::string& name, std::size_t triangles, auto work) {
  benchmark::RegisterBenchmark(
      name.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(work());
        state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(triangles));
      })
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
}

void add_mesh(const std::string& name, Mesh model) {
  const auto mesh = std::make_shared<const Mesh>(std::move(model));
  const auto boxes = std::make_shared<const std::vector<BvhBox>>(boxes_of(*mesh));
  const std::size_t triangles = mesh->triangles.size();
  std::vector<unsigned> threads{1};
  if (processor_count() > 1) threads.push_back(processor_count());
  for (const unsigned n : threads) {
    const std::string on = "/threads:" + std::to_string(n);
    add_line("tree/" + name + on, triangles, [=] {
      Team team(n);
      return build_bvh(*boxes, {}, BvhLeaf::Blocks, team).nodes.size();
    });
    add_line("mesh/" + name + on, triangles,
             [=] { return compile_mesh<float>(mesh, n)->nodes.size(); });
  }
  add_line("compile/" + name, triangles,
           [=] { return compile(scene_of(mesh), KernelKind::Scalar)->stats.bytes; });
}

}  // namespace

void add_building() {
  add_mesh("sphere-70k", bumpy_sphere(70000));
  add_mesh("sphere-1M", bumpy_sphere(1000000));
  add_mesh("hall-1M", column_hall(1000000));
}

}  // namespace lightbench::micro
