#pragma once
// Does the compiler keep floating point as written? The same checks (arithmetic_target.inc) are
// compiled once per instruction set, with the flags of the kernel of that name.

#include <string>
#include <vector>

namespace lightbench::proof::arithmetic {

struct Check {
  std::string what;  ///< type and promise: "float: a*b - c*d is not fused"
  bool kept = false;
};

std::vector<Check> baseline();
#ifdef LIGHTBENCH_X86
/// Only on processors that have AVX2 (x86-64-v3).
std::vector<Check> avx2();
/// Only on processors that have AVX-512 (x86-64-v4).
std::vector<Check> avx512();
#endif

/// The checks with the flags of every kernel that this processor runs, named by instruction set.
std::vector<Check> all_supported();

}  // namespace lightbench::proof::arithmetic
