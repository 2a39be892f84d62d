// Kernel choice at start-up, and rendering through it.

#include <algorithm>
#include <iterator>

#include "core/kernel/dispatch.h"

namespace lightbench {

const char* kernel_name(KernelKind kind) {
  switch (kind) {
    case KernelKind::Auto:
      return "auto";
    case KernelKind::Avx512:
      return "avx512";
    case KernelKind::Avx2:
      return "avx2";
    case KernelKind::Scalar:
      return "scalar";
    case KernelKind::Avx512Double:
      return "avx512-double";
    case KernelKind::Avx2Double:
      return "avx2-double";
    case KernelKind::Reference:
      return "reference";
  }
  return "";
}

bool kernel_supported(KernelKind kind) {
#ifdef LIGHTBENCH_X86
  // The levels x86-64-v3 and v4 by the features that tell their processors apart: clang 14, which
  // lints this file, does not know the levels' names.
  const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                  __builtin_cpu_supports("bmi2") != 0;
  if (kind == KernelKind::Avx2 || kind == KernelKind::Avx2Double) return v3;
  if (kind == KernelKind::Avx512 || kind == KernelKind::Avx512Double) {
    return v3 && __builtin_cpu_supports("avx512f") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
#else
  return kind == KernelKind::Auto || kind == KernelKind::Scalar || kind == KernelKind::Reference;
#endif
  return true;
}

Precision precision_of(KernelKind kind) {
  return kind == KernelKind::Avx512Double || kind == KernelKind::Avx2Double ||
                 kind == KernelKind::Reference
             ? Precision::Double
             : Precision::Float;
}

KernelKind best_kernel(Precision precision) {
  // kKernels lists the widest first, and its plain ones run everywhere.
  return *std::find_if(std::begin(kKernels), std::end(kKernels), [&](KernelKind kind) {
    return precision_of(kind) == precision && kernel_supported(kind);
  });
}

void render(const RenderScene& scene, const Work& work, FilmView film, Counters& counters) {
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    kernel.render(parts.view, work, film, counters);
  });
}

}  // namespace lightbench
