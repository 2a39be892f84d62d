#pragma once
// Where paths begin: the samples of a Work one by one, and their camera rays.

#include "core/camera/camera.h"
#include "core/compile/render_scene.h"
#include "core/kernel/paths.h"

LIGHTBENCH_KERNEL_BEGIN

/// The samples of a Work, pixel by pixel.
class Jobs {
 public:
  Jobs(const Work& work, int film_width)
      : work_(work), x_(work.x0), y_(work.y0), film_width_(film_width), range_(work.ranges) {
    const auto pixels = static_cast<std::uint64_t>(work.x1 - work.x0) *
                        static_cast<std::uint64_t>(work.y1 - work.y0);
    if (range_ == nullptr) {
      left_ = pixels * work.sample_count;
    } else {
      for (std::uint64_t i = 0; i < pixels; ++i) left_ += range_[i].count;
    }
    if (left_ > 0) begin_pixel();
  }

  [[nodiscard]] std::uint64_t left() const { return left_; }

  /// Samples of one pixel that follow each other.
  struct Run {
    int x, y;  ///< film
    std::uint32_t pixel, first_sample, count;
  };
  /// At most `most` (above 0) samples; left() > 0.
  Run take(std::uint32_t most) {
    const std::uint32_t count = left_of_pixel_ < most ? left_of_pixel_ : most;
    const Run run{x_, y_, static_cast<std::uint32_t>(y_ * film_width_ + x_), sample_, count};
    sample_ += count;
    left_ -= count;
    left_of_pixel_ -= count;
    if (left_of_pixel_ == 0 && left_ > 0) {
      next_pixel();
      begin_pixel();
    }
    return run;
  }

 private:
  void next_pixel() {
    if (++x_ == work_.x1) {
      x_ = work_.x0;
      ++y_;
    }
    if (range_ != nullptr) ++range_;
  }
  /// Of the pixel at hand or, as far as it has none, the next that has samples; left_ > 0.
  void begin_pixel() {
    if (range_ == nullptr) {
      sample_ = work_.first_sample;
      left_of_pixel_ = work_.sample_count;
      return;
    }
    while (range_->count == 0) next_pixel();
    sample_ = range_->first;
    left_of_pixel_ = range_->count;
  }

  const Work& work_;
  int x_, y_, film_width_;
  const SampleRange* range_;  // of the pixel at hand, null if all pixels have the same
  std::uint32_t sample_ = 0, left_of_pixel_ = 0;
  std::uint64_t left_ = 0;
};

/// What all paths begin with, in the lanes of m, whose pixels and samples are set.
inline void begin_paths(const SceneView<T>& scene, Mask m, Paths& paths) {
  paths.ray.from = select(m, Int(kNoHit), paths.ray.from);
  paths.ray.from_slot = select(m, Int(kNoHit), paths.ray.from_slot);
  paths.ray.inside = !m && paths.ray.inside;
  paths.throughput = select(m, Vec(Real(1)), paths.throughput);
  paths.radiance = select(m, Vec(Real(0)), paths.radiance);
  paths.pdf = select(m, Real(0), paths.pdf);
  paths.via = select(m, Int(kStraight), paths.via);
  paths.roulette_scale = select(m, Real(1), paths.roulette_scale);
  paths.segments = select(m, Int(0U), paths.segments);
  paths.sampler.reversed_index = reverse_bits(paths.sample);
  paths.sampler.independent = scene.independent_samples;
  paths.alive = paths.alive || m;
}

/// Paths that begin, in the lanes of `active`: samples of the pixels (x, y) of the picture, which
/// are each `stride` pixels wide.
inline Paths start_paths(const SceneView<T>& scene, int stride, Int x, Int y, Int pixel, Int sample,
                         Mask active) {
  Paths paths{};
  paths.alive = false;
  paths.pixel = pixel;
  paths.sample = sample;
  paths.sampler.pixel_key = hash(hash(x, y), Int(scene.seed));
  begin_paths(scene, active, paths);
  const Vec2 u = filter_numbers(paths.sampler);
  // Within a pixel by the filter; the quick look spreads evenly over the block a pixel stands for.
  const Vec2 offset =
      stride == 1 ? sample_filter(scene.camera, u) : Vec2{u.x - T(0.5), u.y - T(0.5)};
  const auto width = static_cast<T>(stride);
  paths.ray = camera_ray(scene, to_real(x) + (T(0.5) + offset.x) * width,
                         to_real(y) + (T(0.5) + offset.y) * width, paths.sampler);
  return paths;
}

LIGHTBENCH_KERNEL_END
