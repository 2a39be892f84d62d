#pragma once
// The BSDFs of the path tracer, at a surface that is described instead of hit.

#include "core/materials/scatter.h"
#include "core/query/lane_arrays.h"
#include "core/query/query_table.h"

LIGHTBENCH_KERNEL_BEGIN

/// The scene with every lobe entered: materials that no surface has can be asked about too.
inline SceneView<T> with_all_lobes(SceneView<T> scene) {
  scene.has_lambertian = scene.has_mirror = scene.has_fuzz = scene.has_ggx = true;
  scene.has_dielectric = true;
  return scene;
}

/// What the path tracer knows of the surface when it scatters.
struct BsdfPoint {
  Material material;
  Frame frame;
  Vec wo;
  Mask entering;
};

inline BsdfPoint load_bsdf_points(const Batch& batch, const SceneView<T>& scene,
                                  std::span<const KernelBsdfQuery> queries) {
  const Vec wo = batch.vec([&](std::size_t i) { return queries[i].wo; });
  const Vec outward = batch.vec([&](std::size_t i) { return queries[i].n; });
  const Mask front = dot(wo, outward) > Real(0);
  const Int material = batch.integer([&](std::size_t i) { return queries[i].material; });
  return {materials_of(scene, material, batch.active()), Frame(select(front, outward, -outward)),
          wo, front};
}

inline void eval_bsdfs(const SceneView<T>& used, std::span<const KernelBsdfQuery> queries,
                       std::span<KernelBsdfValue> values) {
  const SceneView<T> scene = with_all_lobes(used);
  for_each_batch(queries.size(), [&](const Batch& batch) {
    const BsdfPoint at = load_bsdf_points(batch, scene, queries);
    const Vec wi = batch.vec([&](std::size_t i) { return queries[i].wi; });
    const BsdfValue f = eval_bsdf(scene, at.material, at.frame, at.wo, wi);
    const Mask above = dot(at.frame.z, wi) > Real(0);
    batch.each(select(above, f.f, Vec(Real(0))), [&](std::size_t i) { return values[i].value; });
    batch.each(select(above, f.pdf, Real(0)),
               [&](std::size_t i) -> double& { return values[i].pdf; });
  });
}

inline void sample_bsdfs(const SceneView<T>& used, std::span<const KernelBsdfQuery> queries,
                         std::span<KernelBsdfSample> samples) {
  const SceneView<T> scene = with_all_lobes(used);
  for_each_batch(queries.size(), [&](const Batch& batch) {
    const BsdfPoint at = load_bsdf_points(batch, scene, queries);
    const auto unit = [&](std::size_t k) {
      return batch.unit([&](std::size_t i) { return queries[i].u[k]; });
    };
    const BsdfSample s =
        sample_bsdf(scene, at.material, at.frame, at.wo, at.entering, {unit(0), unit(1)}, unit(2));
    batch.each_mask(s.valid, [&](std::size_t i) -> bool& { return samples[i].valid; });
    batch.each_mask(s.delta, [&](std::size_t i) -> bool& { return samples[i].delta; });
    batch.each(s.wi, [&](std::size_t i) { return samples[i].wi; });
    batch.each(s.weight, [&](std::size_t i) { return samples[i].weight; });
    batch.each(select(s.delta, Real(0), s.pdf),
               [&](std::size_t i) -> double& { return samples[i].pdf; });
  });
}

LIGHTBENCH_KERNEL_END
