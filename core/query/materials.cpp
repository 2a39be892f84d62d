#include "core/query/materials.h"

#include "core/kernel/dispatch.h"
#include "core/query/convert.h"

namespace lightbench {
namespace {

KernelBsdfQuery to_kernel(const BsdfQuery& q) {
  KernelBsdfQuery k{};
  k.material = static_cast<std::uint32_t>(q.material);
  put(q.normal / safe_length(q.normal), k.n);
  put(q.wo / safe_length(q.wo), k.wo);
  put(q.wi / safe_length(q.wi), k.wi);
  k.u[0] = q.u;
  k.u[1] = q.v;
  k.u[2] = q.lobe;
  return k;
}

}  // namespace

void eval_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
               std::span<BsdfValue> values) {
  check_lengths(queries.size(), values.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    ask_in_parts<KernelBsdfQuery, KernelBsdfValue>(
        queries, to_kernel,
        [&](auto in, auto out) { kernel.queries->eval_bsdf(parts.view, in, out); },
        [&](std::size_t i, const KernelBsdfValue& k) {
          values[i] = {vec(k.value), k.pdf};
        });
  });
}

void sample_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
                 std::span<BsdfSample> samples) {
  check_lengths(queries.size(), samples.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    ask_in_parts<KernelBsdfQuery, KernelBsdfSample>(
        queries, to_kernel,
        [&](auto in, auto out) { kernel.queries->sample_bsdf(parts.view, in, out); },
        [&](std::size_t i, const KernelBsdfSample& k) {
          samples[i] = {k.valid, k.delta, vec(k.wi), vec(k.weight), k.pdf};
        });
  });
}

}  // namespace lightbench
