#pragma once
// The body of a target's translation unit.

#include "core/kernel/path_tracer.h"
#include "core/kernel/targets.h"

LIGHTBENCH_KERNEL_BEGIN

inline Ray ray_of(const KernelRay& k) {
  const auto vec = [](const double(&v)[3]) {
    return Vec{Real(static_cast<T>(v[0])), Real(static_cast<T>(v[1])), Real(static_cast<T>(v[2]))};
  };
  Ray ray{vec(k.o),    vec(k.d),    Real(static_cast<T>(k.time)),
          Int(kNoHit), Int(kNoHit), Mask(false),
          Int(kNoHit), Int(kNoHit), Mask(false)};
  return ray;
}

inline KernelHit trace_one(const SceneView<T>& scene, const KernelRay& query) {
  const Ray ray = ray_of(query);
  NearestHit hit = no_hit(Real(static_cast<T>(query.t_max)));
  find_hits<false>(scene, ray, Mask(true), hit);
  KernelHit k;
  if (first(hit.primitive) == kNoHit) return k;
  const Surface s =
      surface_of(scene, first(hit.primitive), ray, hit, Mask(true), Coordinates::Wanted);
  const auto put = [](Vec v, double(&out)[3]) {
    out[0] = static_cast<double>(first(v.x));
    out[1] = static_cast<double>(first(v.y));
    out[2] = static_cast<double>(first(v.z));
  };
  k.found = true;
  k.primitive = first(hit.primitive);
  k.t = static_cast<double>(first(hit.t));
  k.u = static_cast<double>(first(s.u));
  k.v = static_cast<double>(first(s.v));
  put(s.p, k.p);
  put(s.ng, k.ng);
  put(s.ns, k.ns);
  put(s.tangent, k.tangent);
  k.front = first(dot(ray.d, s.ng)) < T(0);
  return k;
}

inline bool occluded_one(const SceneView<T>& scene, const KernelRay& query) {
  NearestHit hit = no_hit(Real(static_cast<T>(query.t_max)));
  find_hits<true>(scene, ray_of(query), Mask(true), hit);
  return first(hit.primitive) != kNoHit;
}

LIGHTBENCH_KERNEL_END

namespace lightbench::LIGHTBENCH_TARGET {
extern const KernelTable<T> kernel;
const KernelTable<T> kernel = {render_work, trace_one, occluded_one};
}  // namespace lightbench::LIGHTBENCH_TARGET
