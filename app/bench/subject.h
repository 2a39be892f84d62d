#pragma once
// What a benchmark measures: a scene with settings, rendered again and again with other seeds.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/image_difference.h"
#include "core/compile/render_scene.h"

namespace lightbench::bench {

/// One render stands at `spp` samples per pixel after `seconds` of tracing (wall clock).
struct Rung {
  std::uint32_t spp = 0;
  double seconds = 0;
  Counters counters;
  ImageDifference error;  ///< of the picture so far
};

/// An independent render: the same film at 1, 2, 4, ... samples per pixel.
struct Run {
  std::uint32_t seed = 0;
  std::vector<Rung> rungs;
};

struct Subject {
  std::string name;
  Scene scene;
  KernelKind kernel = KernelKind::Auto;
  int threads = 1;
};

/// A subject, compiled, with the sums over its runs that the maps of a report show.
class Bench {
 public:
  explicit Bench(const Subject& subject, const Image& reference);

  /// Renders with a seed of its own up to `spp` (a power of two), and judges every rung.
  Run run(std::uint32_t seed, std::uint32_t spp);
  /// Seconds that one sample per pixel takes, after one that warms up.
  double seconds_per_sample();

  [[nodiscard]] const RenderStats& stats() const { return scene_->stats; }
  /// Mean over the runs of each pixel's squared relative error at the last rung (mean of the
  /// channels) ...
  [[nodiscard]] std::vector<float> error_map() const;
  /// ... the mean picture less the reference, over the channels ...
  [[nodiscard]] std::vector<float> bias_map() const;
  /// ... and the nanoseconds that one sample of a pixel took, by tiles of kCostTile pixels.
  [[nodiscard]] std::vector<float> cost_map() const;

 private:
  /// Adds samples [first, first + count) to the film; returns the seconds it took.
  double trace(const RenderScene& scene, Film& film, std::uint32_t first, std::uint32_t count,
               Counters& counters);

  Scene source_;
  int threads_;
  const Image& reference_;
  std::shared_ptr<const RenderScene> scene_;
  int runs_ = 0;
  std::uint64_t samples_ = 0;  ///< of each pixel, over all runs
  std::vector<double> squared_, signed_, tile_seconds_;
};

/// Edge of the square tiles that threads take, and whose cost is measured.
inline constexpr int kCostTile = 8;

}  // namespace lightbench::bench
