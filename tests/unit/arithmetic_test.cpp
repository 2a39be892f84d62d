#include <gtest/gtest.h>

#include "app/proof/arithmetic.h"

namespace lightbench {
namespace {

TEST(Arithmetic, IsKeptWithTheFlagsOfEveryKernel) {
  const auto checks = arithmetic::all_supported();
  EXPECT_GE(checks.size(), 13U);
  for (const arithmetic::Check& check : checks) EXPECT_TRUE(check.kept) << "not so: " << check.what;
}

}  // namespace
}  // namespace lightbench
