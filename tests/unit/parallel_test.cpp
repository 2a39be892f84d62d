// Loops over threads: every index once, errors come back.

#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace lightbench {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 9U}) {
    Team team(threads);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}}) {
      std::vector<std::atomic<int>> visits(count);
      team.each(count, [&](std::size_t i) { ++visits[i]; });
      for (const auto& n : visits) EXPECT_EQ(n, 1) << threads;
    }
  }
}

TEST(Parallel, RunsCoverTheWhole) {
  std::vector<std::atomic<int>> visits(1001);
  Team(3).runs(visits.size(), 64, [&](std::size_t begin, std::size_t end) {
    EXPECT_LE(end - begin, 64U);
    for (std::size_t i = begin; i < end; ++i) ++visits[i];
  });
  for (const auto& n : visits) EXPECT_EQ(n, 1);
}

TEST(Parallel, AnErrorComesBackAndEndsTheLoop) {
  std::atomic<int> begun{0};
  const auto run = [&] {
    Team(2).each(1000000, [&](std::size_t i) {
      ++begun;
      if (i == 10) throw std::runtime_error("eleven");
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_LT(begun, 1000000);
}

}  // namespace
}  // namespace lightbench
