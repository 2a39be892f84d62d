#pragma once
// Paths at their first vertex, made and traced a full set of lanes at a time and handed out to the
// lanes that fall free. A lane whose ray leaves the scene takes the next one between tracing and
// shading, so that shading, the dear part, finds all lanes busy (docs/performance.md).

#include "core/camera/in_view.h"
#include "core/kernel/interaction.h"
#include "core/kernel/path_starts.h"
#include "core/kernel/splat.h"
#include "core/kernel/unwatched.h"

LIGHTBENCH_KERNEL_BEGIN

class PathQueue {
 public:
  PathQueue(const SceneView<T>& scene, const Work& work, FilmView film, Counters& counters)
      : scene_(scene),
        work_(work),
        film_(film),
        counters_(counters),
        jobs_(work, film.width),
        in_view_(surfaces_in_view(scene, work)) {}

  /// Fresh paths and what they met in the lanes of `free`, as far as samples are left; returns
  /// which lanes got one.
  Mask fill(Mask free, Paths& paths, Interaction& met) {
    const auto wanted = static_cast<unsigned>(__builtin_popcount(bits(free)));
    while (end_ - begin_ < wanted && jobs_.left() > 0) generate();
    Mask m = free;
    if (end_ - begin_ < wanted) {
      std::uint32_t some = bits(free);
      for (unsigned i = wanted; i > end_ - begin_; --i) some &= some - 1;
      m = mask_from_bits(some);
    }
    const auto take = [&](const auto& from, auto& into) { into = expand(m, from + begin_, into); };
    each_number(paths, met, take);
    begin_paths(scene_, m, paths);
    paths.segments = select(m, Int(1U), paths.segments);
    if (uses(scene_, Feature::Media)) {
      Int scattered = select(met.medium.scattered, Int(1U), Int(0U));
      take(scattered_, scattered);
      met.medium.scattered = scattered != Int(0U);
    }
    begin_ += static_cast<unsigned>(__builtin_popcount(bits(m)));
    return m;
  }

 private:
  /// Fewer than kLanes left over, kLanes new ones, and room to read or write kLanes from any.
  static constexpr unsigned kRoom = 3 * kLanes;

  /// Calls f(array, number of the lanes) for all that differs from path to path.
  void each_number(auto& paths, auto& met, auto f) {
    f(o_[0], paths.ray.o.x);
    f(o_[1], paths.ray.o.y);
    f(o_[2], paths.ray.o.z);
    f(d_[0], paths.ray.d.x);
    f(d_[1], paths.ray.d.y);
    f(d_[2], paths.ray.d.z);
    f(time_, paths.ray.time);
    f(pixel_, paths.pixel);
    f(sample_, paths.sample);
    f(pixel_key_, paths.sampler.pixel_key);
    f(t_, met.hit.t);
    f(primitive_, met.hit.primitive);
    if (uses(scene_, Feature::Triangles)) {
      f(slot_, met.hit.slot);
      f(b_[0], met.hit.b1);
      f(b_[1], met.hit.b2);
    }
    if (uses(scene_, Feature::Media)) {
      f(medium_t_, met.medium.t);
      f(albedo_[0], met.medium.albedo.x);
      f(albedo_[1], met.medium.albedo.y);
      f(albedo_[2], met.medium.albedo.z);
    }
  }

  /// Starts up to kLanes paths and appends those that met something; fewer than kLanes are left
  /// when it is called.
  [[gnu::noinline]] void generate() {
    Int x(0U), y(0U), pixel(0U), sample(0U);
    const Int lane = load(kLaneNumbers);
    unsigned count = 0;
    while (count < kLanes && jobs_.left() > 0) {
      const Jobs::Run run = jobs_.take(kLanes - count);
      // All lanes from here on; those behind the run are the next one's.
      const Mask m = lane >= Int(count);
      // Of the picture: a window of it holds the very samples of the whole.
      const int run_x = run.x * work_.stride + scene_.camera.crop_x;
      const int run_y = run.y * work_.stride + scene_.camera.crop_y;
      x = select(m, Int(static_cast<std::uint32_t>(run_x)), x);
      y = select(m, Int(static_cast<std::uint32_t>(run_y)), y);
      pixel = select(m, Int(run.pixel), pixel);
      sample = select(m, lane + Int(run.first_sample - count), sample);
      count += run.count;
    }
    const Mask all = lane < Int(count);
    Paths paths = start_paths(scene_, work_.stride, x, y, pixel, sample, all);
    Interaction met = intersect(scene_, paths, counters_, in_view_);
    Unwatched unwatched;
    escape(scene_, paths, met, unwatched);
    const Mask kept = paths.alive, gone = all && !kept;
    if (any(gone)) splat(scene_, paths, gone, work_, film_, counters_);

    const unsigned left = end_ - begin_;
    const auto append = [&](auto* to, const auto& from) {
      store(to, load(to + begin_));
      compress(to + left, kept, from);
    };
    each_number(paths, met, append);
    if (uses(scene_, Feature::Media))
      append(scattered_, select(met.medium.scattered, Int(1U), Int(0U)));
    begin_ = 0;
    end_ = left + static_cast<unsigned>(__builtin_popcount(bits(kept)));
  }

  const SceneView<T>& scene_;
  const Work& work_;
  FilmView film_;
  Counters& counters_;
  Jobs jobs_;
  Surfaces in_view_;
  alignas(64) T o_[3][kRoom] = {}, d_[3][kRoom] = {}, time_[kRoom] = {}, t_[kRoom] = {},
                b_[2][kRoom] = {}, medium_t_[kRoom] = {}, albedo_[3][kRoom] = {};
  alignas(64) std::uint32_t pixel_[kRoom] = {}, sample_[kRoom] = {}, pixel_key_[kRoom] = {},
                            primitive_[kRoom] = {}, slot_[kRoom] = {}, scattered_[kRoom] = {};
  unsigned begin_ = 0, end_ = 0;
};

LIGHTBENCH_KERNEL_END
