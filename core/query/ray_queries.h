#pragma once
// Rays through the path tracer's own tests, each lane its own ray.

#include "core/kernel/path_tracer.h"
#include "core/query/lane_arrays.h"
#include "core/query/query_table.h"

LIGHTBENCH_KERNEL_BEGIN

inline Ray load_rays(const Batch& batch, std::span<const KernelRay> rays) {
  Ray ray;
  ray.o = batch.vec([&](std::size_t i) { return rays[i].o; });
  ray.d = batch.vec([&](std::size_t i) { return rays[i].d; });
  ray.time = batch.real([&](std::size_t i) { return rays[i].time; });
  ray.from = batch.integer([&](std::size_t i) { return rays[i].from; });
  ray.from_slot = batch.integer([&](std::size_t i) { return rays[i].from_slot; });
  ray.inside = batch.mask([&](std::size_t i) { return rays[i].inside; });
  ray.skip = ray.skip_slot = Int(kNoHit);
  ray.skip_back = false;
  return ray;
}

inline NearestHit load_ends(const Batch& batch, std::span<const KernelRay> rays) {
  return no_hit(batch.real([&](std::size_t i) { return rays[i].t_max; }));
}

inline void trace_rays(const SceneView<T>& scene, std::span<const KernelRay> rays,
                       std::span<KernelHit> hits) {
  for_each_batch(rays.size(), [&](const Batch& batch) {
    const Ray ray = load_rays(batch, rays);
    NearestHit hit = load_ends(batch, rays);
    find_hits<false>(scene, ray, batch.active(), hit);
    refine_hits(scene, ray, hit);
    const Mask found = batch.active() && hit.primitive != Int(kNoHit);
    const Surface s = surface_of(scene, ray, hit, found, found);
    batch.each_mask(found, [&](std::size_t i) -> bool& { return hits[i].found; });
    batch.each_mask(dot(ray.d, s.ng) < Real(0),
                    [&](std::size_t i) -> bool& { return hits[i].front; });
    batch.each(
        hit.primitive, [&](std::size_t i) -> auto& { return hits[i].primitive; });
    batch.each(
        hit.slot, [&](std::size_t i) -> auto& { return hits[i].slot; });
    batch.each(hit.t, [&](std::size_t i) -> double& { return hits[i].t; });
    batch.each(s.u, [&](std::size_t i) -> double& { return hits[i].u; });
    batch.each(s.v, [&](std::size_t i) -> double& { return hits[i].v; });
    batch.each(s.p, [&](std::size_t i) { return hits[i].p; });
    batch.each(s.ng, [&](std::size_t i) { return hits[i].ng; });
    batch.each(s.ns, [&](std::size_t i) { return hits[i].ns; });
    batch.each(s.tangent, [&](std::size_t i) { return hits[i].tangent; });
  });
}

inline void occlude_rays(const SceneView<T>& scene, std::span<const KernelRay> rays,
                         std::span<std::uint8_t> blocked) {
  for_each_batch(rays.size(), [&](const Batch& batch) {
    NearestHit hit = load_ends(batch, rays);
    find_hits<true>(scene, load_rays(batch, rays), batch.active(), hit);
    batch.each_mask(
        hit.primitive != Int(kNoHit), [&](std::size_t i) -> auto& { return blocked[i]; });
  });
}

inline void leave_surfaces(const SceneView<T>& scene, std::span<const KernelExit> exits,
                           std::span<KernelPoint> origins) {
  for_each_batch(exits.size(), [&](const Batch& batch) {
    const Vec p = batch.vec([&](std::size_t i) { return exits[i].p; });
    const Vec outward = batch.vec([&](std::size_t i) { return exits[i].ng; });
    const Mask inside = batch.mask([&](std::size_t i) { return exits[i].inside; });
    const Int primitive = batch.integer([&](std::size_t i) { return exits[i].primitive; });
    const Vec n = select(inside, -outward, outward);
    batch.each(leave_surface(p, n, pick(scene.offset, primitive)),
               [&](std::size_t i) { return origins[i].p; });
  });
}

LIGHTBENCH_KERNEL_END
