#include "app/bench/subject.h"

#include <chrono>
#include <mutex>

#include "app/on_threads.h"

namespace lightbench::bench {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int tiles_across(int pixels) { return (pixels + kCostTile - 1) / kCostTile; }

}  // namespace

Bench::Bench(const Subject& subject, const Image& reference)
    : source_(subject.scene),
      threads_(subject.threads),
      reference_(reference),
      scene_(compile(subject.scene, subject.kernel)) {
  const Crop& film = scene_->crop;
  const std::size_t pixels = reference.pixel_count();
  squared_.assign(pixels, 0);
  signed_.assign(pixels, 0);
  tile_seconds_.assign(static_cast<std::size_t>(tiles_across(film.width)) *
                           static_cast<std::size_t>(tiles_across(film.height)),
                       0);
}

double Bench::trace(const RenderScene& scene, Film& film, std::uint32_t first, std::uint32_t count,
                    Counters& counters) {
  const int across = tiles_across(film.width());
  std::mutex mutex;
  const double start = now();
  for_each_on_threads(0, tile_seconds_.size(), threads_, [&](std::uint64_t tile) {
    const int x = static_cast<int>(tile) % across * kCostTile;
    const int y = static_cast<int>(tile) / across * kCostTile;
    Work work{x,
              y,
              std::min(x + kCostTile, film.width()),
              std::min(y + kCostTile, film.height()),
              first,
              count,
              1};
    Counters own;
    const double begin = now();
    render(scene, work, film.view(), own);
    tile_seconds_[tile] += now() - begin;  // nobody else has this tile
    const std::lock_guard lock(mutex);
    counters += own;
  });
  return now() - start;
}

double Bench::seconds_per_sample() {
  Film film(reference_.width, reference_.height, scene_->film_unit);
  Counters counters;
  trace(*scene_, film, 0, 1, counters);
  const double seconds = trace(*scene_, film, 1, 1, counters);
  std::fill(tile_seconds_.begin(), tile_seconds_.end(), 0);
  return seconds;
}

Run Bench::run(std::uint32_t seed, std::uint32_t spp) {
  Scene scene = source_;
  scene.render.seed = seed;
  const auto seeded = compile(scene, scene_->kernel, scene_.get(), diff(source_, scene));
  Film film(reference_.width, reference_.height, seeded->film_unit);
  Run run{seed, {}};
  Rung rung;
  Image picture;
  while (rung.spp < spp) {
    const std::uint32_t count = std::max(1U, rung.spp);
    rung.seconds += trace(*seeded, film, rung.spp, count, rung.counters);
    rung.spp += count;
    picture = film.mean(rung.spp);
    rung.error = difference(picture, reference_);
    run.rungs.push_back(rung);
  }
  ++runs_;
  samples_ += spp;
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const double b = reference_.rgb[i], d = picture.rgb[i] - b;
    squared_[i / 3] += d * d / (b * b + kRelativeFloor) / 3;
    signed_[i / 3] += d / 3;
  }
  return run;
}

std::vector<float> Bench::error_map() const {
  std::vector<float> map;
  for (const double s : squared_) map.push_back(static_cast<float>(s / std::max(1, runs_)));
  return map;
}

std::vector<float> Bench::bias_map() const {
  std::vector<float> map;
  for (const double s : signed_) map.push_back(static_cast<float>(s / std::max(1, runs_)));
  return map;
}

std::vector<float> Bench::cost_map() const {
  constexpr std::size_t kEdge = kCostTile;
  const auto width = static_cast<std::size_t>(reference_.width);
  const auto height = static_cast<std::size_t>(reference_.height);
  const auto across = static_cast<std::size_t>(tiles_across(reference_.width));
  const auto samples = static_cast<double>(std::max<std::uint64_t>(1, samples_));
  std::vector<float> map(reference_.pixel_count());
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t tx = x / kEdge, ty = y / kEdge;
      const std::size_t pixels =
          std::min(kEdge, width - tx * kEdge) * std::min(kEdge, height - ty * kEdge);
      map[y * width + x] = static_cast<float>(1e9 * tile_seconds_[ty * across + tx] /
                                              (samples * static_cast<double>(pixels)));
    }
  }
  return map;
}

}  // namespace lightbench::bench
