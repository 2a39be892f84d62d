// Rays per second through meshes: closest hits of bounces and chords, any hits of segments; ours by
// target, and Embree's on the same rays where this build has it.

#include <benchmark/benchmark.h>

#include <cmath>
#include <iterator>

#include "core/compile/render_scene.h"
#include "tests/bench/micro/subjects.h"

namespace lightbench::micro {
namespace {

enum class Kind { Bounces, Chords, Segments };
constexpr const char* kKindNames[] = {"bounces", "chords", "segments"};

const RaySet& rays_of(const Subject& s, Kind kind) {
  return kind == Kind::Bounces ? s.bounces : kind == Kind::Chords ? s.chords : s.segments;
}

using Trace = void (*)(const SceneView<float>&, const RaySet&, std::span<Answer>);

void run_ours(benchmark::State& state, const Subject& s, Kind kind, Trace trace) {
  const RaySet& rays = rays_of(s, kind);
  std::vector<Answer> answers(rays.padded());
  for (auto _ : state) trace(s.parts().view, rays, answers);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size));
}

void add_line(std::size_t i, Kind kind, const std::string& who, auto run) {
  const std::string name =
      std::string(kSubjects[i]) + "/" + kKindNames[static_cast<int>(kind)] + "/" + who;
  benchmark::RegisterBenchmark(name.c_str(),
                               [i, run](benchmark::State& state) { run(state, subject(i)); });
}

void add_target(std::size_t i, Kind kind, const char* target, const KernelLoops<float>& loops) {
  const Trace trace = kind == Kind::Segments ? loops.any : loops.closest;
  add_line(i, kind, target, [kind, trace](benchmark::State& state, const Subject& s) {
    run_ours(state, s, kind, trace);
  });
}

#ifdef LIGHTBENCH_EMBREE
/// Share of the rays for which Embree found something else: nothing where we found something or the
/// reverse, or another distance. Grazed edges are a matter of rounding.
double differences(const Subject& s, Kind kind, const EmbreeScene& embree) {
  const RaySet& rays = rays_of(s, kind);
  std::vector<Answer> ours(rays.padded()), theirs(rays.padded());
  if (kind == Kind::Segments) {
    scalar::loops.any(s.parts().view, rays, ours);
    embree.any(rays, theirs);
  } else {
    scalar::loops.closest(s.parts().view, rays, ours);
    embree.closest(rays, theirs);
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < rays.size; ++i) {
    const bool hit = ours[i].primitive != kNoHit;
    const bool same = hit == (theirs[i].primitive != kNoHit) &&
                      (!hit || kind == Kind::Segments ||
                       std::abs(ours[i].t - theirs[i].t) <= 1e-4F * theirs[i].t);
    different += same ? 0 : 1;
  }
  return static_cast<double>(different) / static_cast<double>(rays.size);
}

void run_embree(benchmark::State& state, const Subject& s, Kind kind, bool robust) {
  const EmbreeScene embree(s.vertices, s.mesh->triangles, robust);
  const double different = differences(s, kind, embree);
  if (different > 1e-3) state.SkipWithError("Embree finds other hits");
  state.counters["different"] = different;
  const RaySet& rays = rays_of(s, kind);
  std::vector<Answer> answers(rays.padded());
  for (auto _ : state) {
    kind == Kind::Segments ? embree.any(rays, answers) : embree.closest(rays, answers);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(rays.size));
}

void add_embree(std::size_t i, Kind kind) {
  for (const bool robust : {true, false}) {
    add_line(i, kind, robust ? "embree-robust" : "embree-fast",
             [kind, robust](benchmark::State& state, const Subject& s) {
               run_embree(state, s, kind, robust);
             });
  }
}
#endif

}  // namespace

void add_traversal() {
  for (std::size_t i = 0; i < std::size(kSubjects); ++i) {
    for (const Kind kind : {Kind::Bounces, Kind::Chords, Kind::Segments}) {
#ifdef LIGHTBENCH_X86
      if (kernel_supported(KernelKind::Avx512)) add_target(i, kind, "avx512", avx512::loops);
      if (kernel_supported(KernelKind::Avx2)) add_target(i, kind, "avx2", avx2::loops);
#endif
      add_target(i, kind, "scalar", scalar::loops);
#ifdef LIGHTBENCH_EMBREE
      add_embree(i, kind);
#endif
    }
  }
}

}  // namespace lightbench::micro
