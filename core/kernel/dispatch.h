#pragma once
// The kernel that a scene was compiled for.

#include <variant>

#include "core/compile/parts.h"
#include "core/kernel/targets.h"

namespace lightbench {

inline const KernelTable<float>& float_kernel(KernelKind kind) {
#ifdef LIGHTBENCH_X86
  if (kind == KernelKind::Avx512) return avx512::kernel;
  if (kind == KernelKind::Avx2) return avx2::kernel;
#endif
  (void)kind;
  return scalar::kernel;
}

/// Calls f(kernel table, compiled parts) with the number type the scene was compiled for.
template <class F>
auto with_kernel(const RenderScene& scene, F f) {
  if (const auto* p = std::get_if<KernelParts<double>>(&scene.parts->kernel)) {
    return f(reference::kernel, *p);
  }
  return f(float_kernel(scene.kernel), std::get<KernelParts<float>>(scene.parts->kernel));
}

}  // namespace lightbench
