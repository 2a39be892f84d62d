#include <gtest/gtest.h>

#include "app/proof/arithmetic.h"
#include "core/compile/render_scene.h"

namespace lightbench {
using namespace proof;
namespace {

void expect_kept(const std::vector<proof::arithmetic::Check>& checks) {
  EXPECT_EQ(checks.size(), 13U);
  for (const proof::arithmetic::Check& check : checks)
    EXPECT_TRUE(check.kept) << "not so: " << check.what;
}

TEST(Arithmetic, IsKeptOnAnyProcessor) { expect_kept(proof::arithmetic::baseline()); }

#ifdef LIGHTBENCH_X86
TEST(Arithmetic, IsKeptWithTheFlagsOfAvx2) {
  if (!kernel_supported(KernelKind::Avx2)) GTEST_SKIP() << "this processor lacks AVX2";
  expect_kept(proof::arithmetic::avx2());
}

TEST(Arithmetic, IsKeptWithTheFlagsOfAvx512) {
  if (!kernel_supported(KernelKind::Avx512)) GTEST_SKIP() << "this processor lacks AVX-512";
  expect_kept(proof::arithmetic::avx512());
}
#endif

// What `lightbench stress` runs.
TEST(Arithmetic, IsCheckedForEveryKernelThatThisProcessorRuns) {
  std::size_t sets = 1;
#ifdef LIGHTBENCH_X86
  if (kernel_supported(KernelKind::Avx2)) ++sets;
  if (kernel_supported(KernelKind::Avx512)) ++sets;
#endif
  EXPECT_EQ(proof::arithmetic::all_supported().size(), 13 * sets);
}

}  // namespace
}  // namespace lightbench
