#pragma once
// Background rendering of the newest scene. One owner thread calls the methods; none of them waits
// for the renderer. A coordinator thread compiles and schedules, workers trace, whole passes are
// published.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/film/frame.h"
#include "core/film/sample_plan.h"
#include "core/scene/scene.h"

namespace lightbench {

struct SessionOptions {
  int threads = 0;            ///< 0 = all; negative = all minus that many, at least 1
  bool interactive = false;   ///< first a quick low-resolution pass; publish often
  bool low_priority = false;  ///< leave the processor to others (nice)
  KernelKind kernel = KernelKind::Auto;
};

enum class SessionState { Idle, Compiling, Rendering, Paused, Finished, Failed };

struct SessionStatus {
  SessionState state = SessionState::Idle;
  std::uint64_t generation = 0;
  std::uint32_t spp = 0;
  std::uint32_t target_spp = 0;   ///< 0 = no limit
  SampleExtent samples;           ///< of the pixels of the last frame; `spp` is their average
  double seconds = 0;             ///< rendering time of this generation, pauses excluded
  double remaining = -1;          ///< estimate in seconds; < 0 if unknown
  double samples_per_second = 0;  ///< paths
  double rays_per_second = 0;     ///< segments plus shadow rays
  Counters counters;              ///< of this generation
  RenderStats scene;
  std::uint64_t film_bytes = 0;
  int threads = 0;
  std::string error;  ///< one line, when Failed
};

class Session {
 public:
  explicit Session(const SessionOptions& options);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Renders `scene` from now on and returns its generation. What to rebuild is found by diff()
  /// against the scene compiled last; a change of target or display only keeps the samples (and the
  /// generation). A scene that fails to compile leaves the last picture up and sets status().error.
  std::uint64_t submit(Scene scene);
  void pause(bool paused);
  /// Starts again at sample 0.
  void restart();

  /// The newest frame, null before the first. Cheap; shared, immutable.
  [[nodiscard]] std::shared_ptr<const Frame> latest() const;
  [[nodiscard]] SessionStatus status() const;
  /// Frames at the counts in RenderSettings::snapshots reached since the last call, with variance,
  /// each of exactly that spp.
  std::vector<std::shared_ptr<const Frame>> take_snapshots();
  /// Asks for a frame with variance of the samples so far; it arrives through take_snapshots().
  void request_snapshot();

  /// Blocks until a frame newer than `serial` is published, a snapshot waits, the state changes to
  /// Finished or Failed, or `seconds` pass. For headless use; the UI polls instead.
  void wait(std::uint64_t serial, double seconds) const;
  /// Called from a worker thread after each publish (the UI posts an empty event in it). Set once,
  /// before the first submit.
  void set_wake(void (*wake)(void*), void* context);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lightbench
