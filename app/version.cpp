#include "app/version.h"

#include <fmt/format.h>

#include "core/compile/render_scene.h"

namespace lightbench {

std::string version_number() { return LIGHTBENCH_VERSION; }

std::string version_text() {
  const std::string commit = LIGHTBENCH_COMMIT;
  std::string kernels;
  for (const KernelKind kind : kKernels) {
    if (!kernel_supported(kind)) continue;
    const bool best = kind == best_kernel(precision_of(kind));
    kernels += fmt::format(" {}{}", kernel_name(kind), best ? " (auto)" : "");
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
