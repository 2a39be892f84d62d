#pragma once
// What the queries pass to and from the kernels: plain numbers in render space, and the functions
// that every target has for them.

#include <cstdint>
#include <span>

#include "core/film/counters.h"
#include "core/film/film.h"
#include "core/kernel/path_end.h"
#include "core/kernel/scene_view.h"

namespace lightbench {

/// Unit direction, time in [0,1] over the shutter.
struct KernelRay {
  double o[3], d[3];
  double time, t_max;
  std::uint32_t from, from_slot;  ///< primitive it left, kNoHit for none; triangle slot of a mesh
  bool inside;                    ///< it left to the inside
};
struct KernelHit {
  bool found, front;
  std::uint32_t primitive, slot;
  double t, u, v;
  double p[3], ng[3], ns[3], tangent[3];
};

/// A ray's way off a surface point.
struct KernelExit {
  double p[3], ng[3];
  std::uint32_t primitive;
  bool inside;
};
struct KernelPoint {
  double p[3];
};

struct KernelLightQuery {
  double p[3], n[3], u[2];  ///< n: 0 looks all around
  double time;
  std::uint32_t choice;  ///< random bits
  std::uint32_t light;   ///< kNoLight: by choice
};
struct KernelLightDirection {
  double p[3], n[3], d[3];
  double time;
  std::uint32_t light;  ///< kNoLight: of the nearest surface
};
struct KernelLightPoint {
  bool valid;
  std::uint32_t light;
  double d[3], n[3], radiance[3];
  double distance, pdf, selection;
};

struct KernelBsdfQuery {
  std::uint32_t material;
  double n[3], wo[3], wi[3], u[3];
};
struct KernelBsdfValue {
  double value[3], pdf;
};
struct KernelBsdfSample {
  bool valid, delta;
  double wi[3], weight[3], pdf;
};

/// One vertex of a path, as path_watch.h writes it down; core/query/path.h says what the parts
/// mean.
struct KernelPathVertex {
  enum class Place { Nowhere, Surface, Medium };
  double o[3], d[3], throughput[3];
  double time;
  Place place;
  std::uint32_t primitive, slot;
  double t, p[3], ng[3], n[3];
  bool front;
  double base_color[3];

  bool emits;
  double emission[3], emission_weight;

  bool light_sampled, light_visible;
  KernelLightPoint light;
  std::uint32_t via;  ///< primitive by way of which it was sampled, or kNoHit
  double light_value[3], light_value_pdf, light_weight, light_added[3];
  std::uint32_t blocker;  ///< primitive, or kNoHit

  bool scattered;
  KernelBsdfSample next;

  double survival;  ///< 1 without roulette
  double radiance[3];
  bool ends;
  PathEnd end;
};

/// Where the vertices of a path go, one after the other, and what became of it.
struct KernelPath {
  void (*add)(void* context, const KernelPathVertex&);
  void* context;
  FilmPixel film;     ///< what the sample adds to its pixel
  Counters counters;  ///< counters.bad_fault if it adds nothing
};

/// Each function answers in[i] in out[i].
template <class T>
struct QueryTable {
  template <class In, class Out>
  using Query = void (*)(const SceneView<T>&, std::span<const In>, std::span<Out>);

  Query<KernelRay, KernelHit> trace;
  Query<KernelRay, std::uint8_t> occluded;
  Query<KernelExit, KernelPoint> leave;
  Query<KernelLightQuery, KernelLightPoint> sample_lights;
  Query<KernelLightDirection, KernelLightPoint> pdf_lights;
  Query<KernelBsdfQuery, KernelBsdfValue> eval_bsdf;
  Query<KernelBsdfQuery, KernelBsdfSample> sample_bsdf;
  /// One sample of the picture.
  void (*trace_path)(const SceneView<T>&, const SampleName&, KernelPath&);
};

}  // namespace lightbench
