#pragma once
// The kernel that a scene was compiled for.

#include <type_traits>
#include <variant>

#include "core/compile/parts.h"
#include "core/kernel/targets.h"

namespace lightbench {

template <class T>
const KernelTable<T>& table_of([[maybe_unused]] KernelKind kind) {
  if constexpr (std::is_same_v<T, double>) {
#ifdef LIGHTBENCH_X86
    if (kind == KernelKind::Avx512Double) return avx512_double::kernel;
    if (kind == KernelKind::Avx2Double) return avx2_double::kernel;
#endif
    return reference::kernel;
  } else {
#ifdef LIGHTBENCH_X86
    if (kind == KernelKind::Avx512) return avx512::kernel;
    if (kind == KernelKind::Avx2) return avx2::kernel;
#endif
    return scalar::kernel;
  }
}

/// Calls f(kernel table, compiled parts) with the number type the scene was compiled for.
template <class F>
auto with_kernel(const RenderScene& scene, F f) {
  return std::visit(
      [&]<class T>(const KernelParts<T>& parts) { return f(table_of<T>(scene.kernel), parts); },
      scene.parts->kernel);
}

}  // namespace lightbench
