#include "app/version.h"

#include <fmt/format.h>

#include "core/compile/render_scene.h"

namespace lightbench {

std::string version_number() { return LIGHTBENCH_VERSION; }

std::string version_text() {
  const std::string commit = LIGHTBENCH_COMMIT;
  std::string kernels;
  for (const KernelKind kind :
       {KernelKind::Avx512, KernelKind::Avx2, KernelKind::Scalar, KernelKind::Reference}) {
    if (!kernel_supported(kind)) continue;
    kernels += fmt::format(" {}{}", kernel_name(kind), kind == best_kernel() ? " (auto)" : "");
  }
  return fmt::format("lightbench {}{}\ncompiler: {} {}\nkernels:{}", version_number(),
                     commit.empty() ? "" : " (" + commit + ")",
#if defined(__clang__)
                     "clang", __clang_version__,
#else
                     "gcc", __VERSION__,
#endif
                     kernels);
}

}  // namespace lightbench
