// Rays per second through one-weekend-final's 485 spheres, on the rays of its own paths: closest
// hits, and any hits as if each ray asked for the sky. Ours by target, and Embree's on the same
// rays where this build has it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/compile/render_scene.h"
#include "core/query/path.h"
#include "core/scene/scene_io.h"
#include "tests/bench/micro/subjects.h"

namespace lightbench::micro {
namespace {

constexpr std::size_t kRays = std::size_t{1} << 18;

struct Spheres {
  std::shared_ptr<const RenderScene> scene;
  std::vector<SphereNumbers> numbers;
  RaySet rays;

  [[nodiscard]] const SceneView<float>& view() const {
    return std::get<KernelParts<float>>(scene->parts->kernel).view;
  }
};

/// A thousandth of a scene unit off the surface they leave (the small spheres have a radius of
/// 0.2), since Embree does not know which that was.
constexpr double kOff = 1e-3;

/// The segments of random paths of the picture, camera rays included, in random order.
std::vector<PathVertex> segments_of(const RenderScene& scene, int width, int height) {
  std::mt19937_64 engine(1);
  std::vector<PathVertex> segments;
  for (std::uint32_t sample = 0; segments.size() < kRays; ++sample) {
    const int x = static_cast<int>(engine() % static_cast<unsigned>(width));
    const int y = static_cast<int>(engine() % static_cast<unsigned>(height));
    std::vector<PathVertex> path = trace_path(scene, {x, y, sample}).vertices;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) {
        const glm::dvec3 n = path[i - 1].geometric_normal;
        path[i].origin += glm::dot(path[i].direction, n) > 0 ? kOff * n : -kOff * n;
      }
      segments.push_back(path[i]);
    }
  }
  std::shuffle(segments.begin(), segments.end(), engine);
  segments.resize(kRays);
  return segments;
}

Spheres make() {
  const Scene scene = load_scene(LIGHTBENCH_SOURCE_DIR "/scenes/one-weekend-final.json");
  Spheres s;
  s.scene = compile(scene, KernelKind::Scalar);
  const auto& parts = std::get<KernelParts<float>>(s.scene->parts->kernel);
  for (std::uint32_t i = 0; i < parts.view.surface_count; ++i) {
    const float* row = parts.view.rows + parts.view.row[i];
    s.numbers.push_back({row[0], row[1], row[2], row[3]});
  }
  for (const PathVertex& v : segments_of(*s.scene, scene.render.width, scene.render.height)) {
    const glm::dvec3 o = parts.geometry->space.to_render(v.origin);
    for (int k = 0; k < 3; ++k) {
      s.rays.o[static_cast<std::size_t>(k)].push_back(static_cast<float>(o[k]));
      s.rays.d[static_cast<std::size_t>(k)].push_back(static_cast<float>(v.direction[k]));
    }
  }
  s.rays.t_max.assign(kRays, std::numeric_limits<float>::infinity());
  s.rays.size = kRays;
  return s;
}

const Spheres& spheres() {
  static const Spheres made = make();
  return made;
}

void add_line(bool any, const std::string& who, auto run) {
  const std::string name = std::string("one-weekend-final/") + (any ? "any/" : "closest/") + who;
  benchmark::RegisterBenchmark(name.c_str(), [run](benchmark::State& state) {
    const Spheres& s = spheres();
    std::vector<Answer> answers(s.rays.padded());
    run(state, s, answers);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(s.rays.size));
  });
}

void add_target(bool any, const char* target, const KernelLoops<float>& loops) {
  const auto trace = any ? loops.any : loops.closest;
  add_line(any, target,
           [trace](benchmark::State& state, const Spheres& s, std::span<Answer> answers) {
             for (auto _ : state) trace(s.view(), s.rays, answers);
           });
}

#ifdef LIGHTBENCH_EMBREE
/// Distances on the ground, whose radius of 1000 is a half in render space, are not better than a
/// few of its roundings where we do not refine them.
constexpr float kGroundError = 8 * 0x1p-24F;

/// Share of the rays for which Embree found something else.
double differences(const Spheres& s, bool any, std::span<const Answer> theirs) {
  std::vector<Answer> ours(s.rays.padded());
  (any ? scalar::loops.any : scalar::loops.closest)(s.view(), s.rays, ours);
  std::size_t different = 0;
  for (std::size_t i = 0; i < s.rays.size; ++i) {
    const bool hit = ours[i].primitive != kNoHit;
    const bool same =
        hit == (theirs[i].primitive != kNoHit) &&
        (!hit || any || std::abs(ours[i].t - theirs[i].t) <= 1e-3F * theirs[i].t + kGroundError);
    different += same ? 0 : 1;
  }
  return static_cast<double>(different) / static_cast<double>(s.rays.size);
}

void add_embree(bool any, const char* who, EmbreeScene::Spheres tested) {
  add_line(any, who, [=](benchmark::State& state, const Spheres& s, std::span<Answer> answers) {
    const EmbreeScene embree(s.numbers, tested);
    const auto trace = [&] { any ? embree.any(s.rays, answers) : embree.closest(s.rays, answers); };
    trace();
    const double different = differences(s, any, answers);
    if (different > 1e-3) state.SkipWithError("Embree finds other hits");
    state.counters["different"] = different;
    for (auto _ : state) trace();
  });
}
#endif

}  // namespace

void add_spheres() {
  for (const bool any : {false, true}) {
#ifdef LIGHTBENCH_X86
    if (kernel_supported(KernelKind::Avx512)) add_target(any, "avx512", avx512::loops);
    if (kernel_supported(KernelKind::Avx2)) add_target(any, "avx2", avx2::loops);
#endif
    add_target(any, "scalar", scalar::loops);
#ifdef LIGHTBENCH_EMBREE
    add_embree(any, "embree-user", EmbreeScene::Spheres::User);
    add_embree(any, "embree-builtin", EmbreeScene::Spheres::BuiltIn);
#endif
  }
}

}  // namespace lightbench::micro
