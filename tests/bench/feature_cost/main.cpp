// What features cost scenes that do not use them: the kernel as it is shipped against ones from
// which a feature was left out at compile time, on a scene without that feature. One thread; for
// each feature the median of the ratios of many pairs of short runs, and the interval that holds
// the median with 95 % confidence.
//
//   bench_feature_cost [PAIRS] [KERNEL]
//
// Fails if a feature surely costs more than kLimit.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "core/compile/parts.h"
#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/kernel/features.h"
#include "core/kernel/targets.h"
#include "core/scene/scene_io.h"

namespace lightbench {

using RenderFunction = void (*)(const SceneView<float>&, const Work&, FilmView, Counters&);
#define LIGHTBENCH_KERNEL_WITHOUT(target, ...) \
  namespace target {                           \
  extern const RenderFunction render;          \
  }
#include "kernels_without.inc"
#undef LIGHTBENCH_KERNEL_WITHOUT

namespace {

constexpr int kSide = 96, kSpp = 4;
constexpr double kLimit = 0.01;  ///< of the time, for each feature

struct Candidate {
  const char* name;
  std::vector<Feature> without;
  RenderFunction render;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all;
#define LIGHTBENCH_KERNEL_WITHOUT(target, ...) \
  all.push_back({#target, {__VA_ARGS__}, target::render});
#include "kernels_without.inc"
#undef LIGHTBENCH_KERNEL_WITHOUT
  return all;
}

struct Subject {
  std::string name;
  std::shared_ptr<const RenderScene> scene;
};

const SceneView<float>& view_of(const RenderScene& scene) {
  return std::get<KernelParts<float>>(scene.parts->kernel).view;
}

double seconds(RenderFunction kernel, const RenderScene& scene) {
  Film film(kSide, kSide, scene.film_unit);
  Counters counters;
  const std::clock_t start = std::clock();  // of the processor: other programs do not count
  kernel(view_of(scene), {0, 0, kSide, kSide, 0, kSpp, 1}, film.view(), counters);
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::vector<Subject> subjects() {
  std::vector<Subject> all;
  for (const char* name : {"cornell-three-lights-static", "cornell-plain", "cornell-box", "quads",
                           "one-weekend-final"}) {
    Scene scene = load_scene(std::string(LIGHTBENCH_SOURCE_DIR) + "/scenes/" + name + ".json");
    scene.render.width = scene.render.height = kSide;
    all.push_back({name, compile(scene, LIGHTBENCH_FEATURE_COST_KERNEL)});
  }
  return all;
}

/// Whether it is within the limit.
bool compare(const Candidate& candidate, const Subject& subject, int pairs) {
  std::vector<double> ratios;
  for (int k = 0; k < pairs; ++k) {
    // Either goes first every second time.
    RenderFunction order[] = {LIGHTBENCH_FEATURE_COST_TARGET::kernel.render, candidate.render};
    if (k % 2 == 1) std::swap(order[0], order[1]);
    const double first = seconds(order[0], *subject.scene);
    const double second = seconds(order[1], *subject.scene);
    ratios.push_back(k % 2 == 1 ? second / first : first / second);
  }
  std::sort(ratios.begin(), ratios.end());
  // Order statistics around the median: its rank is binomial.
  const double half = 0.98 * std::sqrt(static_cast<double>(pairs));
  const auto at = [&](double rank) {
    return ratios[static_cast<std::size_t>(std::clamp(rank, 0.0, pairs - 1.0))];
  };
  const double middle = 0.5 * (pairs - 1);
  const double least = at(std::floor(middle - half)) - 1;
  fmt::print("| {} | {} | {:+.1f} % | {:+.1f} to {:+.1f} % |\n", candidate.name, subject.name,
             100 * (at(middle) - 1), 100 * least, 100 * (at(std::ceil(middle + half)) - 1));
  std::fflush(stdout);
  return least <= kLimit * static_cast<double>(std::max<std::size_t>(candidate.without.size(), 1));
}

int run(int pairs, const std::string& only) {
  const std::vector<Subject> scenes = subjects();
  fmt::print("| kernel | scene | cost of what it does not use | 95 % |\n|---|---|---|---|\n");
  bool cheap = true;
  for (const Candidate& candidate : candidates()) {
    if (!only.empty() && only != candidate.name) continue;
    for (const Subject& subject : scenes) {
      const SceneView<float>& view = view_of(*subject.scene);
      const auto used = [&](Feature f) { return has(view, f); };
      if (std::any_of(candidate.without.begin(), candidate.without.end(), used)) continue;
      cheap = compare(candidate, subject, pairs) && cheap;
      break;
    }
  }
  return cheap ? 0 : 1;
}

}  // namespace
}  // namespace lightbench

int main(int argc, char** argv) {
  return lightbench::run(argc > 1 ? std::atoi(argv[1]) : 101, argc > 2 ? argv[2] : "");
}
