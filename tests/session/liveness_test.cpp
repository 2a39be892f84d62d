// What a person at the window feels: pictures keep coming while edits pour in, no picture mixes two
// scenes, nothing waits, and nothing burns the processor when there is nothing to do.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <random>
#include <thread>

#include "core/session/session.h"
#include "tests/session/session_fixture.h"

namespace lightbench {
namespace {

using Clock = std::chrono::steady_clock;

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Every pixel of `frame` has the radiance that its generation was submitted with.
void expect_one_generation(const Frame& frame, const std::map<std::uint64_t, double>& radiance) {
  const auto found = radiance.find(frame.generation);
  ASSERT_NE(found, radiance.end()) << "generation " << frame.generation;
  const auto expected = static_cast<float>(found->second);
  for (std::size_t i = 0; i < frame.image.rgb.size(); ++i) {
    ASSERT_NEAR(frame.image.rgb[i], expected, 1e-5F)
        << "value " << i << " of generation " << frame.generation << ", divider " << frame.divider;
  }
}

TEST(Liveness, FramesKeepArrivingWhileEditsPourInAndNoneMixesScenes) {
  Session session({.threads = 2, .interactive = true});
  std::map<std::uint64_t, double> radiance;
  std::mt19937 engine(3);
  std::uint64_t serial = 0;
  int edits = 0, frames = 0;
  double longest_submit = 0;
  const auto start = Clock::now();
  while ((frames < 10 || edits < 100) && seconds_since(start) < 60) {
    // Whole passes over this picture last longer than the time between edits.
    Scene scene = plain_scene(1600, 900, static_cast<double>(1 + engine() % 1000) / 1024);
    const double color = scene.environment.color.x;
    const auto before = Clock::now();
    radiance[session.submit(std::move(scene))] = color;
    longest_submit = std::max(longest_submit, seconds_since(before));
    ++edits;
    session.wait(serial, 0.004);
    const auto frame = session.latest();
    if (frame && frame->serial != serial) {
      serial = frame->serial;
      ++frames;
      expect_one_generation(*frame, radiance);
      if (HasFatalFailure()) return;
    }
  }
  RecordProperty("edits", edits);
  RecordProperty("frames", frames);
  EXPECT_GE(frames, 10) << "of " << edits << " edits in a minute";
  EXPECT_GE(edits, 100) << "submit() waited for the renderer, up to " << longest_submit << " s";
}

TEST(Liveness, TheLastEditIsTheOneThatStays) {
  Session session({.threads = 2, .interactive = true});
  std::uint64_t last = 0;
  for (int i = 1; i <= 50; ++i) last = session.submit(plain_scene(320, 200, i / 64.0));
  ASSERT_TRUE(eventually(session, [&] {
    const auto frame = session.latest();
    return frame && frame->generation == last && frame->divider == 1 && frame->spp >= 2;
  }));
  expect_one_generation(*session.latest(), {{last, 50 / 64.0}});
}

TEST(Liveness, NothingRunsWhenPausedOrFinished) {
  Session session({.threads = 2});
  Scene scene = noisy_scene(300, 300, 0);
  session.submit(scene);
  ASSERT_TRUE(eventually(session, [&] { return session.status().spp >= 1; }));
  session.pause(true);
  ASSERT_TRUE(eventually(session, [&] { return session.status().state == SessionState::Paused; }));
  const auto idle_share = [&] {
    // Workers may be within their last call of render() when the state changes.
    session.wait(session.latest()->serial, 0.05);
    const double cpu = process_cpu_seconds();
    const auto start = Clock::now();
    while (seconds_since(start) < 0.3) session.wait(~0ULL >> 1, 0.3);
    return (process_cpu_seconds() - cpu) / seconds_since(start);
  };
  const double seconds = session.status().seconds;
  EXPECT_LT(idle_share(), 0.05) << "paused";
  EXPECT_EQ(session.status().seconds, seconds) << "the clock stands while paused";
  session.pause(false);
  scene.render.spp = 1;
  session.submit(scene);
  ASSERT_TRUE(finish(session));
  const double cpu = process_cpu_seconds();
  const auto start = Clock::now();
  while (seconds_since(start) < 0.3) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_LT(process_cpu_seconds() - cpu, 0.02) << "finished";
}

/// Dear samples in a small picture: paths go on in a closed room until the depth ends them.
Scene slow_scene(int width, int height) {
  Scene scene = noisy_scene(width, height, 0);
  Object room;
  room.shape = SphereShape{.center = {0, 0, 0}, .radius = 50};
  room.material = 0;
  scene.objects.push_back(room);
  scene.render.roulette_depth = scene.render.max_depth;
  return scene;
}

TEST(Liveness, DestructionDoesNotWaitForAPass) {
  for (const bool interactive : {false, true}) {
    auto session =
        std::make_unique<Session>(SessionOptions{.threads = 2, .interactive = interactive});
    // Processor time: a pass that goes on uses it, a busy machine does not. The picture is small,
    // for to make and free the memory of a large one takes time too.
    const std::clock_t start = std::clock();
    session->submit(slow_scene(500, 320));
    if (!eventually(*session, [&] { return session->status().spp >= 1; })) return;
    const std::clock_t before = std::clock();
    session.reset();
    EXPECT_LT(std::clock() - before,
              std::max<std::clock_t>(CLOCKS_PER_SEC / 20, (before - start) / 4));
  }
}

TEST(Liveness, RandomEditsResizesPausesAndCancelsEndInTheRightPicture) {
  Session session({.threads = 3, .interactive = true});
  std::mt19937 engine(11);
  Scene scene = noisy_scene(160, 120, 0);
  std::vector<std::shared_ptr<const Frame>> held;  // a UI keeps frames while newer ones appear
  std::uint64_t serial = 0;
  const auto start = Clock::now();
  while (seconds_since(start) < 3) {
    switch (engine() % 11) {
      case 0:
        scene.render.width = 1 + static_cast<int>(engine() % 500);
        break;
      case 1:
        scene.render.height = 1 + static_cast<int>(engine() % 400);
        break;
      case 2:
        scene.render.spp = static_cast<int>(engine() % 80);
        break;
      case 3:
        scene.render.snapshots = {1, static_cast<int>(engine() % 20)};
        break;
      case 4:
        session.pause(engine() % 2 == 0);
        break;
      case 5:
        session.restart();
        break;
      case 6:
        session.request_snapshot();
        break;
      case 7:
        scene.display.exposure += 0.5;
        break;
      case 8:
        scene.render.adaptive = !scene.render.adaptive;
        break;
      default:
        scene.camera.look_from.x = static_cast<double>(engine() % 100) / 100;
        break;
    }
    session.submit(scene);
    session.wait(serial, 0.001 * static_cast<double>(engine() % 12));
    if (const auto frame = session.latest()) {
      EXPECT_GE(frame->serial, serial);
      serial = frame->serial;
      held.push_back(frame);
      if (held.size() > 4) held.erase(held.begin());
    }
    for (const auto& snapshot : session.take_snapshots()) {
      EXPECT_EQ(snapshot->variance.size(), snapshot->image.pixel_count());
      EXPECT_EQ(snapshot->divider, 1);
    }
  }
  scene.render.width = 97;
  scene.render.height = 53;
  scene.render.spp = 40;
  scene.render.adaptive = true;
  session.pause(false);
  session.submit(scene);
  session.restart();
  ASSERT_TRUE(finish(session));
  EXPECT_TRUE(same_bits(session.latest()->image.rgb, render_to_end(scene, 1)->image.rgb));
}

}  // namespace
}  // namespace lightbench
