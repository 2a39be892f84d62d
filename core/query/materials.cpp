#include "core/query/materials.h"

#include <cmath>
#include <limits>

#include "core/kernel/dispatch.h"
#include "core/query/convert.h"

namespace lightbench {
namespace {

/// A direction that T cannot tell from a unit one stays as it is, so that a sample comes back as it
/// went: scaled by a rounding, one at the rim of its lobe would be outside.
template <class T>
glm::dvec3 unit(const glm::dvec3& v) {
  const double length = safe_length(v);
  return std::abs(length - 1) <= 4.0 * std::numeric_limits<T>::epsilon() ? v : v / length;
}

template <class T>
KernelBsdfQuery to_kernel(const BsdfQuery& q) {
  KernelBsdfQuery k{};
  k.material = static_cast<std::uint32_t>(q.material);
  put(unit<T>(q.normal), k.n);
  put(unit<T>(q.wo), k.wo);
  put(unit<T>(q.wi), k.wi);
  k.u[0] = q.u;
  k.u[1] = q.v;
  k.u[2] = q.w;
  return k;
}

}  // namespace

void eval_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
               std::span<BsdfValue> values) {
  check_lengths(queries.size(), values.size());
  with_kernel(scene, [&]<class T>(const KernelTable<T>& kernel, const KernelParts<T>& parts) {
    ask_in_parts<KernelBsdfQuery, KernelBsdfValue>(
        queries, to_kernel<T>,
        [&](auto in, auto out) { kernel.queries->eval_bsdf(parts.view, in, out); },
        [&](std::size_t i, const KernelBsdfValue& k) {
          values[i] = {vec(k.value), k.pdf};
        });
  });
}

void sample_bsdf(const RenderScene& scene, std::span<const BsdfQuery> queries,
                 std::span<BsdfSample> samples) {
  check_lengths(queries.size(), samples.size());
  with_kernel(scene, [&]<class T>(const KernelTable<T>& kernel, const KernelParts<T>& parts) {
    ask_in_parts<KernelBsdfQuery, KernelBsdfSample>(
        queries, to_kernel<T>,
        [&](auto in, auto out) { kernel.queries->sample_bsdf(parts.view, in, out); },
        [&](std::size_t i, const KernelBsdfSample& k) {
          samples[i] = {k.valid, k.delta, vec(k.wi), vec(k.weight), k.pdf};
        });
  });
}

}  // namespace lightbench
