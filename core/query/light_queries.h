#pragma once
// Light sampling and its densities, as next-event estimation uses them.

#include "core/kernel/path_tracer.h"
#include "core/query/lane_arrays.h"
#include "core/query/query_table.h"

LIGHTBENCH_KERNEL_BEGIN

/// `selection`: probability with which a point at `at` chooses the light.
inline void put_light_points(const Batch& batch, Mask valid, Int light, const LightSample& s,
                             Vec radiance, Real selection, std::span<KernelLightPoint> points) {
  const Int known = select(valid, light, Int(0U));
  batch.each_mask(valid, [&](std::size_t i) -> bool& { return points[i].valid; });
  batch.each(
      known, [&](std::size_t i) -> auto& { return points[i].light; });
  batch.each(s.d, [&](std::size_t i) { return points[i].d; });
  batch.each(s.n, [&](std::size_t i) { return points[i].n; });
  batch.each(radiance, [&](std::size_t i) { return points[i].radiance; });
  batch.each(s.distance, [&](std::size_t i) -> double& { return points[i].distance; });
  batch.each(s.pdf, [&](std::size_t i) -> double& { return points[i].pdf; });
  batch.each(selection, [&](std::size_t i) -> double& { return points[i].selection; });
}

/// Probability with which each point chooses its light; images in mirrors and glass have the rest.
inline Real selection_of(const SceneView<T>& scene, const Chooser& at, Int light, Mask active) {
  Real scale(1);
  if (scene.candidate_count > 0) {
    const Real total = contributions(scene, at).total;
    scale = select(total > Real(0), Real(1) / total, Real(0));
  }
  return pmf_of_light(scene, at, select(active, light, Int(0U)), Int(kStraight), scale, active);
}

/// A light for each point: as the path tracer chooses, but for images in mirrors and glass.
inline Int choose_lights(const SceneView<T>& scene, const Chooser& at, Int random, Mask active) {
  SceneView<T> direct = scene;
  direct.candidate_count = scene.direct_candidates;
  direct.face_count = direct.lens_count = 0;
  Real scale;
  return choose_light(direct, at, random, active, scale).light;
}

inline void sample_light_points(const SceneView<T>& scene,
                                std::span<const KernelLightQuery> queries,
                                std::span<KernelLightPoint> points) {
  for_each_batch(queries.size(), [&](const Batch& batch) {
    const Vec from = batch.vec([&](std::size_t i) { return queries[i].p; });
    const Real time = batch.real([&](std::size_t i) { return queries[i].time; });
    const Vec2 u{batch.unit([&](std::size_t i) { return queries[i].u[0]; }),
                 batch.unit([&](std::size_t i) { return queries[i].u[1]; })};
    const Int choice = batch.integer([&](std::size_t i) { return queries[i].choice; });
    const Int named = batch.integer([&](std::size_t i) { return queries[i].light; });
    const Chooser at{from, batch.vec([&](std::size_t i) { return queries[i].n; })};
    const Int light =
        select(named == Int(kNoLight), choose_lights(scene, at, choice, batch.active()), named);
    const LightPlace place = place_of(scene, light);
    const LightSample s = sample_light(scene, place, from, time, u, batch.active());
    const Vec radiance = light_radiance(scene, place, s, probe_ray(from, s.d, time));
    const Mask valid = s.valid && batch.active();
    put_light_points(batch, valid, light, s, radiance, selection_of(scene, at, light, valid),
                     points);
  });
}

/// Where the rays meet the primitives of their own lights, whatever else is in the way.
inline NearestHit hit_lights(const SceneView<T>& scene, LightPlace place, const Ray& ray,
                             Mask active) {
  NearestHit hit = no_hit(Real(kInfinity));
  for_each_distinct(place.primitive, active, [&](std::uint32_t i, Mask m) {
    if (static_cast<PrimitiveKind>(scene.kind[i]) != PrimitiveKind::Mesh) {
      with_kind(scene, i, [&]<PrimitiveKind kKind>() {
        test_primitive<false, kKind, TestOrder::Any>(scene, i, ray, m, hit);
      });
      return;
    }
    const TriangleHit h = hit_triangle(mesh_light(scene, place, m).triangle, ray);
    const Mask met = m && h.hit && h.t > Real(0);
    hit.t = select(met, h.t, hit.t);
    hit.b1 = select(met, h.b1, hit.b1);
    hit.b2 = select(met, h.b2, hit.b2);
    hit.primitive = select(met, Int(i), hit.primitive);
    hit.slot = select(met, place.slot, hit.slot);
  });
  return hit;
}

inline void pdf_light_points(const SceneView<T>& scene,
                             std::span<const KernelLightDirection> queries,
                             std::span<KernelLightPoint> points) {
  for_each_batch(queries.size(), [&](const Batch& batch) {
    const Ray ray = probe_ray(batch.vec([&](std::size_t i) { return queries[i].p; }),
                              batch.vec([&](std::size_t i) { return queries[i].d; }),
                              batch.real([&](std::size_t i) { return queries[i].time; }));
    const Int named = batch.integer([&](std::size_t i) { return queries[i].light; });
    const Mask nearest = batch.active() && named == Int(kNoLight);
    const Mask alone = batch.active() && !nearest;
    NearestHit hit = no_hit(Real(kInfinity));
    if (any(nearest)) find_hits<false>(scene, ray, nearest, hit);
    if (any(alone)) {
      const NearestHit own =
          hit_lights(scene, place_of(scene, select(alone, named, Int(0U))), ray, alone);
      hit.t = select(alone, own.t, hit.t);
      hit.primitive = select(alone, own.primitive, hit.primitive);
      hit.slot = select(alone, own.slot, hit.slot);
      hit.b1 = select(alone, own.b1, hit.b1);
      hit.b2 = select(alone, own.b2, hit.b2);
    }
    refine_hits(scene, ray, hit);
    const Mask met = batch.active() && hit.primitive != Int(kNoHit);
    Vertex v;
    find_surface(scene, ray, hit, met, v);
    const auto [light, valid, mesh] = light_of(scene, hit, met);
    LightSample s{ray.d, v.surface.ng, hit.t, Real(0), valid};
    s.pdf = pdf_light(scene, {hit.primitive, hit.slot}, ray.o, ray.time, ray.d, hit.t, v.surface.ng,
                      valid);
    const Mask bright = valid && (dot(ray.d, v.surface.ng) < Real(0) || v.material.two_sided);
    const Chooser at{ray.o, batch.vec([&](std::size_t i) { return queries[i].n; })};
    put_light_points(batch, valid, light, s, select(bright, v.material.emission, Vec(Real(0))),
                     selection_of(scene, at, light, valid), points);
  });
}

LIGHTBENCH_KERNEL_END
