#pragma once
// One path, traced by the path tracer's own steps and written down on the way.

#include "core/kernel/path_tracer.h"
#include "core/query/query_table.h"

LIGHTBENCH_KERNEL_BEGIN

/// Lane 0 as plain numbers.
inline void put(Vec v, double (&out)[3]) {
  out[0] = static_cast<double>(first(v.x));
  out[1] = static_cast<double>(first(v.y));
  out[2] = static_cast<double>(first(v.z));
}
inline double number(Real x) { return static_cast<double>(first(x)); }
inline bool is_true(Mask m) { return (bits(m) & 1U) != 0; }

/// What the steps report of the path in lane 0, into the vertex at hand.
class PathWatch {
 public:
  static constexpr bool kOn = true;

  void begin(const Paths& paths) {
    v_ = {};
    v_.primitive = v_.blocker = v_.via = kNoHit;
    v_.survival = 1;
    put(paths.ray.o, v_.o);
    put(paths.ray.d, v_.d);
    v_.time = number(paths.ray.time);
    put(paths.throughput, v_.throughput);
  }

  void vertex(const Vertex& v, const NearestHit& hit, const MediumHit& medium) {
    const bool in_medium = is_true(v.in_medium);
    v_.place = in_medium ? KernelPathVertex::Place::Medium : KernelPathVertex::Place::Surface;
    v_.primitive = in_medium ? kNoHit : first(hit.primitive);
    v_.slot = first(hit.slot);
    v_.t = number(in_medium ? medium.t : hit.t);
    put(in_medium ? v.reflect_from : v.surface.p, v_.p);
    put(v.surface.ng, v_.ng);
    put(v.n, v_.n);
    v_.front = is_true(v.front);
    put(v.material.base_color, v_.base_color);
  }

  void emitted(Mask m, Vec radiance, Real weight) {
    if (!is_true(m)) return;
    v_.emits = true;
    put(radiance, v_.emission);
    v_.emission_weight = number(weight);
  }

  void light_sampled(const LightChoice& chosen, const LightSample& s, Vec wi,
                     const BsdfValue& value, Vec emission, Real weight, Int via) {
    v_.light_sampled = true;
    v_.via = first(via);
    v_.light.valid = is_true(s.valid);
    v_.light.light = first(chosen.light);
    v_.light.selection = number(chosen.pmf);
    put(wi, v_.light.d);
    put(s.n, v_.light.n);
    v_.light.distance = number(s.distance);
    v_.light.pdf = number(s.pdf);
    put(emission, v_.light.radiance);
    put(value.f, v_.light_value);
    v_.light_value_pdf = number(value.pdf);
    v_.light_weight = number(weight);
  }

  void light_arrived(Int blocker, Mask visible, Vec added) {
    v_.blocker = first(blocker);
    v_.light_visible = is_true(visible);
    if (v_.light_visible) put(added, v_.light_added);
  }

  void scattered(const BsdfSample& next) {
    if (v_.ends) return;
    v_.scattered = true;
    v_.next.valid = is_true(next.valid);
    v_.next.delta = is_true(next.delta);
    put(next.wi, v_.next.wi);
    put(next.weight, v_.next.weight);
    v_.next.pdf = v_.next.delta ? 0 : number(next.pdf);
  }

  void roulette(Mask m, Real survival) {
    if (is_true(m)) v_.survival = number(survival);
  }

  /// The first time that the path is not going on says why.
  void going(Mask m, PathEnd reason) {
    if (v_.ends || is_true(m)) return;
    v_.ends = true;
    v_.end = reason;
  }

  const KernelPathVertex& end_vertex(const Paths& paths) {
    put(paths.radiance, v_.radiance);
    return v_;
  }

 private:
  KernelPathVertex v_{};
};

inline void watch_path(const SceneView<T>& picture, const SampleName& name, KernelPath& path) {
  // A film of that one pixel: samples depend on the picture's pixel only.
  SceneView<T> scene = picture;
  scene.camera.crop_x = name.x;
  scene.camera.crop_y = name.y;
  const Work work{0, 0, 1, 1, name.sample, 1, 1};
  const FilmView film{&path.film, 1};
  const Mask lane = mask_from_bits(1U);
  Paths paths =
      start_paths(scene, 1, Int(static_cast<std::uint32_t>(name.x)),
                  Int(static_cast<std::uint32_t>(name.y)), Int(0U), Int(name.sample), lane);
  PathWatch watch;
  while (any(paths.alive)) {
    watch.begin(paths);
    const Interaction met = intersect(scene, paths, path.counters);
    escape(scene, paths, met, watch);
    watch.going(paths.alive, PathEnd::Escaped);
    if (any(paths.alive)) shade(scene, paths, met, path.counters, watch);
    path.add(path.context, watch.end_vertex(paths));
  }
  splat(scene, paths, lane, work, film, path.counters);
}

LIGHTBENCH_KERNEL_END
