#include "core/session/schedule.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lightbench {
namespace {

/// Ends of all passes until the schedule stops (or `limit` passes).
std::vector<std::uint32_t> pass_ends(Progress progress, const std::vector<int>& stops,
                                     int limit = 1000) {
  std::vector<std::uint32_t> ends;
  for (int i = 0; i < limit; ++i) {
    const auto pass = next_pass(progress, stops);
    if (!pass) break;
    if (pass->divider > 1) {
      progress.looked = pass->divider;
      continue;
    }
    EXPECT_EQ(pass->first_sample, progress.spp);
    EXPECT_GE(pass->sample_count, 1U);
    progress.looked = 1;
    progress.spp += pass->sample_count;
    if (progress.speed > 0) {
      progress.seconds +=
          pass->sample_count * double(progress.width) * progress.height / progress.speed;
    }
    ends.push_back(progress.spp);
  }
  return ends;
}

TEST(Schedule, PassesDoubleAndStopAtSnapshotsAndTarget) {
  Progress progress{.width = 600, .height = 600, .target = 50};
  EXPECT_EQ(pass_ends(progress, {10, 20, 20, 200, 0, -3}),
            (std::vector<std::uint32_t>{1, 2, 4, 8, 10, 16, 20, 32, 50}));
  EXPECT_EQ(pass_ends(progress, {}), (std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 50}));
}

TEST(Schedule, EndsWhenTheTargetIsReachedOrLowered) {
  Progress progress{.width = 8, .height = 8, .spp = 64, .target = 64};
  EXPECT_FALSE(next_pass(progress, {}));
  progress.target = 10;
  EXPECT_FALSE(next_pass(progress, {}));
  progress.target = 0;
  ASSERT_TRUE(next_pass(progress, {}));
  EXPECT_EQ(next_pass(progress, {})->sample_count, 64U);
}

TEST(Schedule, NoPassIsPredictedToLastLongerThanASecond) {
  Progress progress{.width = 1000, .height = 1000, .spp = 1 << 10, .speed = 5.5e6};
  EXPECT_EQ(next_pass(progress, {})->sample_count, 5U);
  progress.speed = 3e5;  // a single sample lasts 3 s: there is nothing smaller than a whole pass
  EXPECT_EQ(next_pass(progress, {})->sample_count, 1U);
}

TEST(Schedule, TimeLimitEndsTheRenderButNeverBeforeOneSample) {
  Progress progress{.width = 1000, .height = 1000, .target = 1000, .time_limit = 10, .speed = 2e6};
  const auto ends = pass_ends(progress, {});
  EXPECT_GE(ends.back(), 18U);
  EXPECT_LE(ends.back(), 21U);
  progress.time_limit = 0.001;
  EXPECT_EQ(pass_ends(progress, {}), (std::vector<std::uint32_t>{1}));
}

TEST(Schedule, FirstLookFitsItsBudgetAndIsNotCancellable) {
  Progress progress{.width = 1280, .height = 720, .interactive = true, .look_speed = 2e6};
  const auto look = next_pass(progress, {});
  ASSERT_TRUE(look);
  EXPECT_FALSE(look->cancellable);
  EXPECT_EQ(look->sample_count, 1U);
  EXPECT_EQ(look->divider, 7);  // 183x103 = 18849 samples, 9 ms; 214x120 would last 13 ms
}

TEST(Schedule, FinerLooksLeadToTheFirstPassAndCanBeCancelled) {
  Progress progress{.width = 1280, .height = 720, .interactive = true, .look_speed = 4e5};
  std::vector<int> dividers;
  while (dividers.empty() || dividers.back() > 1) {
    const auto pass = next_pass(progress, {});
    ASSERT_TRUE(pass);
    EXPECT_EQ(pass->cancellable, !dividers.empty());
    EXPECT_EQ(pass->sample_count, 1U);
    dividers.push_back(pass->divider);
    progress.looked = pass->divider;
  }
  EXPECT_EQ(dividers, (std::vector<int>{10, 5, 3, 1}));
  // None of them is rendered again, nor where one sample is all that is wanted.
  progress.spp = progress.target = 1;
  EXPECT_FALSE(next_pass(progress, {}));
}

TEST(Schedule, FinerLooksCostLittle) {
  for (int first = 2; first < 100; ++first) {
    double cost = 0;  // in full passes
    int divider = finer_divider(first);
    for (; divider > 1; divider = finer_divider(divider)) {
      EXPECT_LT(divider, first);
      cost += 1.0 / (divider * divider);
    }
    EXPECT_EQ(divider, 1);
    EXPECT_LT(cost, 0.21);
  }
}

TEST(Schedule, LookShrinksWithSpeedButNotBelow128Pixels) {
  for (const double speed : {0.0, 1e3, 1e5, 1e6, 1e7, 1e8}) {
    for (const auto& [width, height] : {std::pair{1280, 720}, {3840, 2160}, {600, 600}, {90, 50}}) {
      const int divider = look_divider(width, height, speed);
      ASSERT_GE(divider, 1);
      if (divider > 1) {
        EXPECT_GE(std::max(width, height) / divider, 128) << speed << " " << width;
      }
      const double pixels =
          std::ceil(double(width) / divider) * std::ceil(double(height) / divider);
      if (speed > 0 && pixels > kLookSeconds * speed) {
        EXPECT_EQ(divider, std::max(1, std::max(width, height) / 128));
      }
    }
  }
  EXPECT_EQ(look_divider(600, 600, 1e9), 1);
}

TEST(Schedule, FastScenesSkipTheLookAndHeadlessNeverLooks) {
  Progress progress{.width = 100, .height = 100, .interactive = true, .look_speed = 1e8};
  const auto first = next_pass(progress, {});
  EXPECT_EQ(first->divider, 1);
  EXPECT_FALSE(first->cancellable) << "it is the first picture";
  progress.interactive = false;
  progress.width = 4000;
  progress.look_speed = 1e5;
  EXPECT_EQ(*next_pass(progress, {}), (Pass{1, 0, 1, true}));
}

TEST(Schedule, PublishesEverMoreRarely) {
  double before = 0;
  for (double t = 0; t < 20; t += 0.01) {
    const double interval = publish_interval(true, t);
    EXPECT_GE(interval, before);
    before = interval;
  }
  EXPECT_EQ(publish_interval(true, 0), 0.03);
  EXPECT_EQ(publish_interval(true, 100), 2);
}

TEST(Schedule, RemainingIsTheNearerOfTargetAndTimeLimit) {
  Progress progress{.width = 100, .height = 100, .spp = 50, .target = 150, .seconds = 1};
  EXPECT_LT(estimate_remaining(progress), 0);
  progress.speed = 1e5;
  EXPECT_DOUBLE_EQ(estimate_remaining(progress), 10);
  progress.time_limit = 4;
  EXPECT_DOUBLE_EQ(estimate_remaining(progress), 3);
  progress.spp = 150;
  EXPECT_EQ(estimate_remaining(progress), 0);
}

TEST(Schedule, TilesKeepCallsShortAndThreadsBusy) {
  const Tiling fast = plan_tiles(1280, 720, 1, 2, 4e6);
  EXPECT_EQ(fast, (Tiling{64, 1}));
  // Few samples call for large tiles, many for small ones.
  EXPECT_EQ(plan_tiles(300, 300, 1, 2, 7e6), (Tiling{32, 1}));
  EXPECT_EQ(plan_tiles(300, 300, 16, 2, 7e6), (Tiling{16, 16}));
  EXPECT_EQ(plan_tiles(600, 600, 1, 2, 7e6), (Tiling{64, 1}));
  EXPECT_EQ(plan_tiles(600, 600, 28, 2, 7e6), (Tiling{16, 28}));
  EXPECT_EQ(plan_tiles(600, 600, 256, 1, 16e6), (Tiling{16, 250}));
  for (const double speed : {0.0, 1e4, 1e6, 1e8}) {
    for (const int threads : {1, 2, 64}) {
      for (const std::uint32_t samples : {1U, 7U, 1000U}) {
        const Tiling tiling = plan_tiles(1280, 720, samples, threads, speed);
        EXPECT_GE(tiling.edge, 8);
        EXPECT_GE(tiling.samples, 1U);
        EXPECT_LE(tiling.samples, samples);
        if (speed > 0) {
          const double seconds =
              tiling.edge * tiling.edge * double(tiling.samples) * threads / speed;
          EXPECT_LE(seconds, std::max(0.0041, 64.0 * threads / speed)) << speed << " " << threads;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lightbench
