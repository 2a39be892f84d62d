#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/arithmetic_checks.h"

namespace lightbench {
namespace {

TEST(Arithmetic, IsKeptOnAnyProcessor) { EXPECT_THAT(arithmetic::baseline(), testing::IsEmpty()); }

#ifdef LIGHTBENCH_X86
TEST(Arithmetic, IsKeptForAvx2) {
  if (__builtin_cpu_supports("x86-64-v3") == 0) GTEST_SKIP() << "needs AVX2";
  EXPECT_THAT(arithmetic::avx2(), testing::IsEmpty());
}

TEST(Arithmetic, IsKeptForAvx512) {
  if (__builtin_cpu_supports("x86-64-v4") == 0) GTEST_SKIP() << "needs AVX-512";
  EXPECT_THAT(arithmetic::avx512(), testing::IsEmpty());
}
#endif

}  // namespace
}  // namespace lightbench
