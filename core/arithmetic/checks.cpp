#include "core/arithmetic/checks.h"

namespace lightbench::arithmetic {

std::vector<Check> all_supported() {
  std::vector<Check> all;
  const auto add = [&all](const std::string& flags, const std::vector<Check>& checks) {
    for (const Check& check : checks) all.push_back({flags + ", " + check.what, check.kept});
  };
  add("any processor", baseline());
#ifdef LIGHTBENCH_X86
  if (__builtin_cpu_supports("x86-64-v3") != 0) add("avx2", avx2());
  if (__builtin_cpu_supports("x86-64-v4") != 0) add("avx512", avx512());
#endif
  return all;
}

}  // namespace lightbench::arithmetic
