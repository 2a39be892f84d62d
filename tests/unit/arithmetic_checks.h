#pragma once
// Does the compiler keep floating point as written? The same checks (arithmetic_checks.inc) are
// compiled once per instruction set, with the flags of the kernel of that name.

#include <string>
#include <vector>

namespace lightbench::arithmetic {

/// One line per broken promise; empty if arithmetic is kept.
std::vector<std::string> baseline();
#ifdef LIGHTBENCH_X86
/// Only on processors that have AVX2 (x86-64-v3).
std::vector<std::string> avx2();
/// Only on processors that have AVX-512 (x86-64-v4).
std::vector<std::string> avx512();
#endif

}  // namespace lightbench::arithmetic
