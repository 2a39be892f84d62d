#include "core/session/session.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>

#include "core/session/worker_pool.h"
#include "tests/session/session_fixture.h"

namespace lightbench {
namespace {

TEST(Session, IsIdleBeforeTheFirstScene) {
  Session session({.threads = 2});
  EXPECT_EQ(session.status().state, SessionState::Idle);
  EXPECT_EQ(session.status().threads, 2);
  EXPECT_FALSE(session.latest());
  session.restart();
  session.request_snapshot();
  session.pause(true);
  session.wait(0, 0.01);
  EXPECT_FALSE(session.latest());
}

TEST(Session, FinishesAtItsTargetWithEverySampleCounted) {
  Session session({.threads = 3});
  const auto generation = session.submit(noisy_scene(70, 45, 13));
  ASSERT_TRUE(finish(session));
  const SessionStatus status = session.status();
  EXPECT_EQ(status.generation, generation);
  EXPECT_EQ(status.spp, 13U);
  EXPECT_EQ(status.target_spp, 13U);
  EXPECT_EQ(status.remaining, 0);
  EXPECT_EQ(status.counters.paths, 13U * 70 * 45);
  EXPECT_EQ(status.counters.non_finite, 0U);
  EXPECT_GE(status.counters.rays, status.counters.paths);
  EXPECT_GT(status.samples_per_second, 0);
  EXPECT_EQ(status.film_bytes, 70U * 45 * sizeof(FilmPixel));
  const auto frame = session.latest();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->spp, 13U);
  EXPECT_EQ(frame->divider, 1);
  EXPECT_EQ(frame->generation, generation);
  EXPECT_EQ(frame->image.width, 70);
  EXPECT_EQ(frame->image.height, 45);
  EXPECT_TRUE(frame->variance.empty());
  EXPECT_TRUE(frame->scene);
}

TEST(Session, SnapshotsEqualSeparateRendersBitForBit) {
  Scene scene = noisy_scene(50, 40, 37);
  scene.render.snapshots = {10, 200, 3, 37, 10};
  Session session({.threads = 2});
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  const auto snapshots = session.take_snapshots();
  ASSERT_EQ(snapshots.size(), 3U);
  EXPECT_TRUE(session.take_snapshots().empty());
  const std::uint32_t counts[] = {3, 10, 37};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(snapshots[i]->spp, counts[i]);
    Scene alone = noisy_scene(50, 40, static_cast<int>(counts[i]));
    alone.render.snapshots = {static_cast<int>(counts[i])};
    Session other({.threads = 1});
    other.submit(alone);
    ASSERT_TRUE(finish(other));
    const auto expected = other.take_snapshots();
    ASSERT_EQ(expected.size(), 1U);
    EXPECT_TRUE(same_bits(snapshots[i]->image.rgb, expected[0]->image.rgb)) << counts[i];
    EXPECT_TRUE(same_bits(snapshots[i]->variance, expected[0]->variance)) << counts[i];
    EXPECT_EQ(snapshots[i]->variance.size(), 50U * 40);
  }
}

/// Lets the session end, pausing it and asking for snapshots on the way.
void finish_with_pauses(Session& session) {
  std::mt19937 engine(1);
  while (session.status().state != SessionState::Finished) {
    session.pause(true);
    if (engine() % 4 == 0) session.request_snapshot();
    session.wait(session.latest() ? session.latest()->serial : 0, 0.001);
    session.pause(false);
    session.wait(session.latest() ? session.latest()->serial : 0, 0.001);
  }
}

/// The picture of `scene` for any number of threads, in a window with pauses, and once more there.
void expect_always(const Scene& scene, const Frame& expected) {
  for (const int threads : {2, 3, 5, 7}) {
    const auto frame = render_to_end(scene, threads);
    ASSERT_TRUE(frame);
    EXPECT_TRUE(same_bits(frame->image.rgb, expected.image.rgb)) << threads << " threads";
  }
  Session session({.threads = 2, .interactive = true, .low_priority = true});
  session.submit(scene);
  finish_with_pauses(session);
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, expected.image.rgb)) << "interactive";
  session.restart();
  ASSERT_TRUE(finish(session));
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, expected.image.rgb)) << "again";
}

TEST(Session, ThreadsPassesPausesAndLooksDoNotChangeABit) {
  const Scene scene = noisy_scene(90, 61, 64);
  const auto expected = render_to_end(scene, 1);
  ASSERT_TRUE(expected);
  expect_always(scene, *expected);
}

TEST(Session, AdaptivePicturesDoNotDependOnThreadsPassesOrPauses) {
  Scene scene = noisy_scene(90, 61, 128);
  scene.render.adaptive = true;
  Session plain({.threads = 1});
  plain.submit(scene);
  ASSERT_TRUE(finish(plain));
  const SessionStatus status = plain.status();
  EXPECT_EQ(status.counters.paths, 128U * 90 * 61);
  EXPECT_LT(status.samples.least, 64U);
  EXPECT_GT(status.samples.most, 192U);
  EXPECT_EQ(status.film_bytes, 90U * 61 * (sizeof(FilmPixel) + 28));
  expect_always(scene, *plain.latest());
}

TEST(Session, AdaptiveSnapshotsEqualSeparateRendersAndThePlainOnesWhileUniform) {
  Scene scene = noisy_scene(50, 40, 100);
  scene.render.adaptive = true;
  scene.render.snapshots = {5, 16, 40, 100};
  Session session({.threads = 2});
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  const auto snapshots = session.take_snapshots();
  ASSERT_EQ(snapshots.size(), 4U);
  for (const auto& snapshot : snapshots) {
    Scene alone = noisy_scene(50, 40, static_cast<int>(snapshot->spp));
    for (const bool adaptive : {true, false}) {
      alone.render.adaptive = adaptive;
      alone.render.snapshots = {alone.render.spp};
      Session other({.threads = 1});
      other.submit(alone);
      ASSERT_TRUE(finish(other));
      const auto expected = other.take_snapshots();
      ASSERT_EQ(expected.size(), 1U);
      const bool same = adaptive || snapshot->spp <= kUniformSpp;
      EXPECT_EQ(same_bits(snapshot->image.rgb, expected[0]->image.rgb), same) << snapshot->spp;
      EXPECT_EQ(same_bits(snapshot->variance, expected[0]->variance), same) << snapshot->spp;
    }
  }
}

TEST(Session, AdaptiveSamplingTurnedOnAndOffLeavesNoTrace) {
  Scene scene = noisy_scene(40, 30, 64);
  const auto plain = render_to_end(scene);
  Session session({.threads = 2});
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  const std::uint64_t bytes = session.status().film_bytes;
  scene.render.adaptive = true;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  EXPECT_FALSE(same_bits(session.latest()->image.rgb, plain->image.rgb));
  scene.render.spp = 300;  // goes on from there
  session.submit(scene);
  ASSERT_TRUE(eventually(session, [&] { return session.status().spp == 300; }));
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, render_to_end(scene)->image.rgb));
  scene.render.spp = 64;
  scene.render.adaptive = false;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, plain->image.rgb));
  EXPECT_EQ(session.status().film_bytes, bytes);
  EXPECT_EQ(session.status().samples.most, 64U);
}

TEST(Session, CropHoldsThePixelsOfTheWholePicture) {
  Scene scene = noisy_scene(64, 48, 4);
  const auto whole = render_to_end(scene);
  scene.render.crop = {11, 7, 20, 9};
  const auto window = render_to_end(scene);
  ASSERT_TRUE(whole && window);
  ASSERT_EQ(window->image.width, 20);
  ASSERT_EQ(window->image.height, 9);
  for (std::size_t y = 0; y < 9; ++y) {
    const float* a = &window->image.rgb[3 * 20 * y];
    const float* b = &whole->image.rgb[3 * (64 * (y + 7) + 11)];
    EXPECT_EQ(std::memcmp(a, b, 3 * 20 * sizeof(float)), 0) << "row " << y;
  }
}

TEST(Session, TargetAndDisplayEditsKeepTheSamples) {
  Scene scene = noisy_scene(40, 30, 8);
  Session session({.threads = 2});
  const auto generation = session.submit(scene);
  ASSERT_TRUE(finish(session));
  scene.display.exposure = 2;
  EXPECT_EQ(session.submit(scene), generation);
  scene.render.spp = 21;
  EXPECT_EQ(session.submit(scene), generation);
  ASSERT_TRUE(eventually(session, [&] { return session.status().spp == 21; }));
  ASSERT_TRUE(finish(session));
  EXPECT_EQ(session.status().counters.paths, 21U * 40 * 30);
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, render_to_end(scene)->image.rgb));
  scene.render.spp = 5;
  EXPECT_EQ(session.submit(scene), generation);
  ASSERT_TRUE(eventually(session, [&] { return session.status().target_spp == 5; }));
  ASSERT_TRUE(finish(session));
  EXPECT_EQ(session.status().spp, 21U);
  scene.render.snapshots = {21};
  EXPECT_EQ(session.submit(scene), generation);
  ASSERT_TRUE(eventually(session, [&] {
    const auto taken = session.take_snapshots();
    return taken.size() == 1 && taken[0]->spp == 21;
  })) << "a count asked for just when it is reached";
}

TEST(Session, LoweringTheTargetEndsARenderWithoutLimit) {
  Scene scene = noisy_scene(64, 64, 0);
  Session session({.threads = 2, .interactive = true});
  const auto generation = session.submit(scene);
  ASSERT_TRUE(eventually(session, [&] { return session.status().spp >= 4; }));
  scene.render.spp = 1;
  EXPECT_EQ(session.submit(scene), generation);
  ASSERT_TRUE(finish(session));
  EXPECT_EQ(session.latest()->spp, session.status().spp) << "the last picture holds all samples";
}

TEST(Session, AnotherSceneIsANewGeneration) {
  Session session({.threads = 2});
  Scene scene = plain_scene(32, 32, 0.25);
  scene.render.spp = 2;
  const auto first = session.submit(scene);
  ASSERT_TRUE(finish(session));
  scene.environment.color = glm::dvec3(0.5);
  const auto second = session.submit(scene);
  EXPECT_GT(second, first);
  EXPECT_NE(session.status().state, SessionState::Finished) << "wait() must not return early";
  ASSERT_TRUE(finish(session));
  EXPECT_EQ(session.latest()->generation, second);
  EXPECT_FLOAT_EQ(session.latest()->image.rgb[100], 0.5F);
}

TEST(Session, RestartBeginsAgainAndEndsAlike) {
  const Scene scene = noisy_scene(40, 30, 6);
  Session session({.threads = 2});
  const auto generation = session.submit(scene);
  ASSERT_TRUE(finish(session));
  const auto before = session.latest();
  session.restart();
  ASSERT_TRUE(finish(session));
  const auto after = session.latest();
  EXPECT_GT(after->generation, generation);
  EXPECT_EQ(after->spp, 6U);
  EXPECT_TRUE(same_bits(before->image.rgb, after->image.rgb));
  EXPECT_EQ(session.status().counters.paths, 6U * 40 * 30);
}

TEST(Session, ASceneThatFailsLeavesThePictureUp) {
  Session session({.threads = 2});
  Scene scene = plain_scene(16, 16, 0.5);
  scene.render.spp = 1;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  const auto good = session.latest();
  Scene broken = scene;
  broken.render.width = broken.render.height = 1'000'000;  // no film is that large
  session.submit(broken);
  ASSERT_TRUE(eventually(session, [&] { return session.status().state == SessionState::Failed; }));
  EXPECT_NE(session.status().error.find("1000000x1000000"), std::string::npos)
      << session.status().error;
  EXPECT_EQ(session.latest(), good);
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  EXPECT_EQ(session.status().error, "");
  EXPECT_GT(session.latest()->serial, good->serial);
}

TEST(Session, InteractiveShowsALookFirst) {
  // Large enough that a whole pass does not fit the time of a look on any machine of today.
  const int width = 4096, height = 2160;
  Session session({.threads = 2, .interactive = true});
  session.submit(plain_scene(width, height, 0.5));
  ASSERT_TRUE(eventually(session, [&] { return session.latest() != nullptr; }));
  const auto look = session.latest();
  ASSERT_GT(look->divider, 1);
  EXPECT_EQ(look->spp, 1U);
  EXPECT_EQ(look->image.width, (width + look->divider - 1) / look->divider);
  EXPECT_EQ(look->image.height, (height + look->divider - 1) / look->divider);
  EXPECT_GE(look->image.width, 128);
  EXPECT_FLOAT_EQ(look->image.rgb.back(), 0.5F);
  // Then ever finer ones, down to the whole picture.
  std::vector<int> dividers{look->divider};
  ASSERT_TRUE(eventually(session, [&] {
    const auto frame = session.latest();
    if (frame->divider != dividers.back()) {
      dividers.push_back(frame->divider);
      EXPECT_EQ(frame->image.width, (width + frame->divider - 1) / frame->divider);
      EXPECT_EQ(frame->spp, 1U);
    }
    return frame->divider == 1;
  }));
  EXPECT_GT(dividers.size(), 2U);
  EXPECT_TRUE(std::is_sorted(dividers.rbegin(), dividers.rend()));
}

TEST(Session, LooksLeaveNoTraceInThePicture) {
  Scene scene = noisy_scene(600, 400, 2);
  Session session({.threads = 2, .interactive = true});
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  scene.camera.vfov += 1;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  ASSERT_EQ(session.latest()->divider, 1);
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, render_to_end(scene)->image.rgb));
}

TEST(Session, TimeLimitEndsARender) {
  Scene scene = noisy_scene(64, 64, 0);
  scene.render.time_limit = 0.2;
  Session session({.threads = 2});
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  EXPECT_GE(session.status().spp, 1U);
  EXPECT_EQ(session.latest()->spp, session.status().spp);
}

TEST(Session, RequestedSnapshotsArriveRunningPausedAndFinished) {
  Scene scene = noisy_scene(200, 200, 0);
  Session session({.threads = 2});
  session.submit(scene);
  std::vector<std::shared_ptr<const Frame>> taken;
  const auto arrives = [&] {
    taken = session.take_snapshots();
    return !taken.empty();
  };
  session.request_snapshot();
  ASSERT_TRUE(eventually(session, arrives));
  EXPECT_EQ(taken[0]->variance.size(), 200U * 200);
  session.pause(true);
  ASSERT_TRUE(eventually(session, [&] { return session.status().state == SessionState::Paused; }));
  session.request_snapshot();
  ASSERT_TRUE(eventually(session, arrives));
  const std::uint32_t paused_at = taken[0]->spp;
  EXPECT_EQ(session.status().spp, paused_at) << "all samples, although paused within a pass";
  ASSERT_TRUE(eventually(session, [&] { return session.status().state == SessionState::Paused; }));
  scene.render.spp = 1;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  session.request_snapshot();
  ASSERT_TRUE(eventually(session, arrives));
  EXPECT_EQ(taken[0]->spp, paused_at);
}

TEST(Session, EditsWhilePausedStillShowALook) {
  Session session({.threads = 2, .interactive = true});
  session.submit(plain_scene(1024, 1024, 0.25));
  session.pause(true);
  const auto generation = session.submit(plain_scene(1024, 1024, 0.75));
  ASSERT_TRUE(eventually(session, [&] {
    const auto frame = session.latest();
    return frame && frame->generation == generation;
  }));
  ASSERT_TRUE(eventually(session, [&] { return session.status().state == SessionState::Paused; }));
  session.pause(false);
  ASSERT_TRUE(eventually(session, [&] { return session.status().spp >= 2; }));
}

TEST(Session, WakeIsCalledForEachFrame) {
  std::atomic<int> wakes{0};
  {
    Session session({.threads = 2});
    session.set_wake([](void* count) { ++*static_cast<std::atomic<int>*>(count); }, &wakes);
    Scene scene = noisy_scene(30, 30, 20);
    scene.render.snapshots = {2, 5, 9};
    session.submit(scene);
    ASSERT_TRUE(finish(session));
    EXPECT_EQ(session.take_snapshots().size(), 3U);
  }
  EXPECT_GE(wakes, 5) << "first pass, three snapshots, end";
}

TEST(ThreadCount, NegativeLeavesSomeFree) {
  const int all = thread_count(0);
  EXPECT_GE(all, 1);
  EXPECT_EQ(thread_count(5), 5);
  EXPECT_EQ(thread_count(-1), std::max(1, all - 1));
  EXPECT_EQ(thread_count(-1000), 1);
}

}  // namespace
}  // namespace lightbench
