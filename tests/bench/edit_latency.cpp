// Times from an edit to the pictures that follow, as a person feels them:
//   bench_edit_latency [SCENE [WIDTHxHEIGHT [EDITS [THREADS]]]]
// moves the camera EDITS times and times the first new picture, the second, and the first of full
// resolution. Every other edit comes before that, so that edits meet every stage of a render.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "core/scene/scene_io.h"
#include "core/session/priority.h"
#include "core/session/session.h"

namespace {

using Clock = std::chrono::steady_clock;

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

void print(const char* what, const std::vector<double>& times) {
  fmt::print("{:<18} median {:7.2f} ms, p99 {:7.2f} ms\n", what, percentile(times, 0.5),
             percentile(times, 0.99));
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

  react_promptly();  // as the viewer
  Session session(options);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Camera home = scene.camera;
  const double distance = glm::length(home.look_from - home.look_at);
  std::vector<double> submit, first, second, full;
  std::vector<int> dividers;
  std::uint64_t serial = 0;
  for (int edit = 0; edit < edits + 6; ++edit) {
    scene.camera.look_from =
        home.look_from +
        0.05 * distance * glm::dvec3(uniform(engine), uniform(engine), uniform(engine));
    Scene copy = scene;
    const auto start = Clock::now();
    const std::uint64_t generation = session.submit(std::move(copy));
    const double submitted = milliseconds(Clock::now() - start);
    const bool interrupted = edit % 2 == 1;
    std::vector<double> times;
    const std::shared_ptr<const Frame> frame = [&] {
      for (;;) {
        session.wait(serial, 10);
        std::shared_ptr<const Frame> latest = session.latest();
        if (!latest || latest->serial == serial) continue;
        serial = latest->serial;
        if (latest->generation != generation) continue;
        times.push_back(milliseconds(Clock::now() - start));
        if (edit >= 6) dividers.push_back(latest->divider);
        if (interrupted || latest->divider == 1) return latest;
      }
    }();
    if (edit >= 6) {  // the first ones measure the speed that later ones rely on
      submit.push_back(submitted);
      first.push_back(times.front());
      if (times.size() > 1) second.push_back(times[1]);
      if (frame->divider == 1) full.push_back(times.back());
    }
    if (!interrupted) continue;
    const auto next = Clock::now() + std::chrono::milliseconds(engine() % 300);
    while (Clock::now() < next) {
      session.wait(serial, std::chrono::duration<double>(next - Clock::now()).count());
      serial = session.latest()->serial;
    }
  }
  const SessionStatus status = session.status();
  fmt::print("{} at {}x{}, {} edits, {} threads\n", file, scene.render.width, scene.render.height,
             edits, status.threads);
  std::sort(dividers.begin(), dividers.end());
  dividers.erase(std::unique(dividers.begin(), dividers.end()), dividers.end());
  fmt::print("dividers {}\n", fmt::join(dividers, " "));
  print("submit()", submit);
  print("first picture", first);
  if (!second.empty()) print("second picture", second);
  if (!full.empty()) print("full resolution", full);
}
