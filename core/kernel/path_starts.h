#pragma once
// Where paths begin: the samples of a Work, numbered, and their camera rays.

#include "core/camera/camera.h"
#include "core/compile/render_scene.h"
#include "core/film/film.h"
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

  struct Job {
    int x, y;  ///< film
    std::uint32_t pixel, sample;
  };
  /// left() > 0.
  Job take() {
    const Job job{x_, y_, static_cast<std::uint32_t>(y_ * film_width_ + x_), sample_++};
    --left_;
    if (--left_of_pixel_ == 0 && left_ > 0) {
      next_pixel();
      begin_pixel();
    }
    return job;
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

/// Camera rays made a full set of lanes at a time and handed out to the lanes that fall free, which
/// are a third of them at each step or fewer.
class PathStarts {
 public:
  PathStarts(const SceneView<T>& scene, const Work& work, const FilmView& film)
      : scene_(scene), work_(work), jobs_(work, film.width) {}

  /// Fresh paths in the lanes of `dead`, as far as samples are left; returns which lanes got one.
  Mask fill(Mask dead, Paths& paths) {
    const auto wanted = static_cast<unsigned>(__builtin_popcount(bits(dead)));
    if (end_ - begin_ < wanted && jobs_.left() > 0) generate();
    Mask m = dead;
    if (end_ - begin_ < wanted) {
      std::uint32_t some = bits(dead);
      for (unsigned i = wanted; i > end_ - begin_; --i) some &= some - 1;
      m = mask_from_bits(some);
    }
    const auto expand_vec = [&](const T(&from)[3][3 * kLanes], Vec old) {
      return Vec{expand(m, from[0] + begin_, old.x), expand(m, from[1] + begin_, old.y),
                 expand(m, from[2] + begin_, old.z)};
    };
    paths.ray.o = expand_vec(o_, paths.ray.o);
    paths.ray.d = expand_vec(d_, paths.ray.d);
    paths.ray.time = expand(m, time_ + begin_, paths.ray.time);
    paths.ray.from = select(m, Int(kNoHit), paths.ray.from);
    paths.ray.from_slot = select(m, Int(kNoHit), paths.ray.from_slot);
    paths.ray.inside = !m && paths.ray.inside;
    paths.pixel = expand(m, pixel_ + begin_, paths.pixel);
    paths.sample = expand(m, sample_ + begin_, paths.sample);
    paths.sampler.pixel_key = expand(m, pixel_key_ + begin_, paths.sampler.pixel_key);
    paths.sampler.reversed_index = reverse_bits(paths.sample);
    paths.sampler.independent = scene_.independent_samples;
    paths.throughput = select(m, Vec(Real(1)), paths.throughput);
    paths.radiance = select(m, Vec(Real(0)), paths.radiance);
    paths.pdf = select(m, Real(0), paths.pdf);
    paths.via = select(m, Int(kStraight), paths.via);
    paths.roulette_scale = select(m, Real(1), paths.roulette_scale);
    paths.segments = select(m, Int(0U), paths.segments);
    paths.alive = paths.alive || m;
    begin_ += static_cast<unsigned>(__builtin_popcount(bits(m)));
    return m;
  }

 private:
  /// Appends up to kLanes starts; fewer than that are left when it is called.
  void generate() {
    const auto to_front = [&](auto* p) { store(p, load(p + begin_)); };
    for (T(&a)[3 * kLanes] : o_) to_front(a);
    for (T(&a)[3 * kLanes] : d_) to_front(a);
    to_front(time_);
    to_front(pixel_);
    to_front(sample_);
    to_front(pixel_key_);
    end_ -= begin_;
    begin_ = 0;

    alignas(64) std::uint32_t xs[kLanes] = {}, ys[kLanes] = {};
    unsigned count = 0;
    for (; count < kLanes && jobs_.left() > 0; ++count) {
      const Jobs::Job job = jobs_.take();
      pixel_[end_ + count] = job.pixel;
      sample_[end_ + count] = job.sample;
      // Of the picture: a window of it holds the very samples of the whole.
      xs[count] = static_cast<std::uint32_t>(job.x * work_.stride + scene_.camera.crop_x);
      ys[count] = static_cast<std::uint32_t>(job.y * work_.stride + scene_.camera.crop_y);
    }
    const Int x = load(xs), y = load(ys);
    const Sampler sampler{hash(hash(x, y), Int(scene_.seed)), reverse_bits(load(sample_ + end_)),
                          scene_.independent_samples};
    const Vec2 u = sampler.pair(Int(dimension::kFilter));
    // Within a pixel by the filter; the quick look spreads evenly over the block a pixel stands
    // for.
    const Vec2 offset =
        work_.stride == 1 ? sample_filter(scene_.camera, u) : Vec2{u.x - T(0.5), u.y - T(0.5)};
    const auto stride = static_cast<T>(work_.stride);
    const Ray ray = camera_ray(scene_, to_real(x) + (T(0.5) + offset.x) * stride,
                               to_real(y) + (T(0.5) + offset.y) * stride, sampler);
    store(o_[0] + end_, ray.o.x);
    store(o_[1] + end_, ray.o.y);
    store(o_[2] + end_, ray.o.z);
    store(d_[0] + end_, ray.d.x);
    store(d_[1] + end_, ray.d.y);
    store(d_[2] + end_, ray.d.z);
    store(time_ + end_, ray.time);
    store(pixel_key_ + end_, sampler.pixel_key);
    end_ += count;
  }

  const SceneView<T>& scene_;
  const Work& work_;
  Jobs jobs_;
  // Fewer than kLanes left over, kLanes new ones, and room to read kLanes from any of them.
  alignas(64) T o_[3][3 * kLanes] = {}, d_[3][3 * kLanes] = {}, time_[3 * kLanes] = {};
  alignas(64) std::uint32_t pixel_[3 * kLanes] = {}, sample_[3 * kLanes] = {},
                                       pixel_key_[3 * kLanes] = {};
  unsigned begin_ = 0, end_ = 0;
};

LIGHTBENCH_KERNEL_END
