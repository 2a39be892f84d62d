// Time from an edit to the first new picture, as a person feels it:
//   bench_edit_latency [SCENE [WIDTHxHEIGHT [EDITS [THREADS]]]]
// moves the camera EDITS times, each time waits for the first frame of that edit, then lets a
// random part of a second pass so that edits meet every stage of a render. Prints milliseconds.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/scene/scene_io.h"
#include "core/session/session.h"

namespace {

using Clock = std::chrono::steady_clock;

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

double milliseconds(Clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace lightbench;
  const std::string file =
      argc > 1 ? argv[1] : LIGHTBENCH_SOURCE_DIR "/scenes/cornell-three-lights.json";
  Scene scene = load_scene(file);
  scene.render.width = 1280;
  scene.render.height = 720;
  if (argc > 2 && std::sscanf(argv[2], "%dx%d", &scene.render.width, &scene.render.height) != 2) {
    fmt::print(stderr, "usage: bench_edit_latency [SCENE [WIDTHxHEIGHT [EDITS [THREADS]]]]\n");
    return 2;
  }
  const int edits = argc > 3 ? std::max(1, std::atoi(argv[3])) : 200;
  SessionOptions options;
  options.threads = argc > 4 ? std::atoi(argv[4]) : -1;  // as the viewer
  options.interactive = true;
  options.low_priority = true;

  Session session(options);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Camera home = scene.camera;
  const double distance = glm::length(home.look_from - home.look_at);
  std::vector<double> first, submit;
  std::vector<int> dividers;
  std::uint64_t serial = 0;
  for (int edit = 0; edit < edits + 5; ++edit) {
    scene.camera.look_from =
        home.look_from +
        0.05 * distance * glm::dvec3(uniform(engine), uniform(engine), uniform(engine));
    Scene copy = scene;
    const auto start = Clock::now();
    const std::uint64_t generation = session.submit(std::move(copy));
    const auto submitted = Clock::now();
    for (;;) {
      session.wait(serial, 10);
      const auto frame = session.latest();
      if (!frame) continue;
      serial = frame->serial;
      if (frame->generation != generation) continue;
      if (edit >= 5) {  // the first ones measure the speed that later ones rely on
        first.push_back(milliseconds(Clock::now() - start));
        submit.push_back(milliseconds(submitted - start));
        dividers.push_back(frame->divider);
      }
      break;
    }
    const auto next = Clock::now() + std::chrono::milliseconds(engine() % 300);
    while (Clock::now() < next) {
      session.wait(serial, std::chrono::duration<double>(next - Clock::now()).count());
      serial = session.latest()->serial;
    }
  }
  std::sort(dividers.begin(), dividers.end());
  const SessionStatus status = session.status();
  fmt::print("{} at {}x{}, {} edits, {} threads\n", file, scene.render.width, scene.render.height,
             edits, status.threads);
  fmt::print("first picture: median {:.1f} ms, p99 {:.1f} ms, divider {}..{}, median {}\n",
             percentile(first, 0.5), percentile(first, 0.99), dividers.front(), dividers.back(),
             dividers[dividers.size() / 2]);
  fmt::print("submit():      median {:.3f} ms, p99 {:.3f} ms\n", percentile(submit, 0.5),
             percentile(submit, 0.99));
}
