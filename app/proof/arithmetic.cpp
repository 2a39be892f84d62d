#include "app/proof/arithmetic.h"

#include "core/compile/render_scene.h"

namespace lightbench::proof::arithmetic {

std::vector<Check> all_supported() {
  std::vector<Check> all;
  const auto add = [&all](const std::string& flags, const std::vector<Check>& checks) {
    for (const Check& check : checks) all.push_back({flags + ", " + check.what, check.kept});
  };
  add("any processor", baseline());
#ifdef LIGHTBENCH_X86
  if (kernel_supported(KernelKind::Avx2)) add("avx2", avx2());
  if (kernel_supported(KernelKind::Avx512)) add("avx512", avx512());
#endif
  return all;
}

}  // namespace lightbench::proof::arithmetic
