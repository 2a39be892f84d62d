#pragma once
// The thread of a session that compiles, schedules passes and publishes frames.

#include <memory>
#include <optional>
#include <string>

#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/film/sample_plan.h"
#include "core/session/exchange.h"
#include "core/session/schedule.h"
#include "core/session/worker_pool.h"

namespace lightbench {

/// Lives on its own thread inside run(); everything but the exchange and the pool is its own. The
/// loop takes what changed, finishes or cancels the pass, then adopts the newest scene, publishes,
/// and asks schedule.h for the next pass. It sleeps whenever there is nothing to do.
class Coordinator {
 public:
  Coordinator(Exchange& exchange, const SessionOptions& options);
  /// Returns when the exchange says quit.
  void run();

 private:
  struct Requests {
    std::shared_ptr<const Scene> scene;  ///< null if none was submitted
    std::uint64_t generation = 0;
    bool snapshot = false;
    bool pass_done = false;
    bool quit = false;
  };

  Requests take_requests();
  void accept(const Requests& requests);
  void finish_pass();
  void adopt_pending();
  void publish_due();
  void start_next();

  void fail(const std::string& error);
  void publish(std::shared_ptr<const Frame> frame, bool is_snapshot);
  [[nodiscard]] bool is_due(std::uint32_t spp, double time) const;
  float* means_after(const Pass& pass);
  void make_room_for_means();
  void resize_films();
  [[nodiscard]] Image picture() const;
  std::shared_ptr<const Frame> make_look();
  std::shared_ptr<const Frame> make_frame(bool with_variance);
  std::shared_ptr<Frame> new_frame(std::uint32_t spp, Image image);
  void run_clock(bool running);
  [[nodiscard]] double seconds() const;
  void report(SessionState state);
  [[nodiscard]] Progress progress() const;
  [[nodiscard]] std::optional<Pass> next() const;

  Exchange& exchange_;
  const SessionOptions options_;

  // The scene being rendered and, once an edit is submitted, the one that follows.
  std::shared_ptr<const Scene> scene_;           // null until one compiled
  std::shared_ptr<const RenderScene> compiled_;  // of scene_
  std::uint64_t generation_ = 0;
  std::shared_ptr<const Scene> pending_;
  std::uint64_t pending_generation_ = 0;
  std::string error_;  // of generation_; nothing is rendered while set

  Film film_;
  SamplePlan plan_;  // of an adaptive picture, whose present round film_ holds; else off
  Film look_;
  Image means_;                  // of film_, from the workers, if a pass is likely to be published
  std::uint32_t means_spp_ = 0;  // the samples that they are of, 0 = none
  std::optional<Pass> running_;
  double pass_started_ = 0;
  bool paused_ = false;
  bool snapshot_wanted_ = false;

  // Of this generation.
  int looked_ = 0;  // see Progress
  std::uint32_t spp_ = 0;
  std::uint32_t published_spp_ = 0;
  SampleExtent samples_;  // of the picture published last
  double published_at_ = 0;
  std::uint32_t snapshot_spp_ = 0;  // count of the last snapshot made
  Counters counters_;
  double pass_seconds_ = 0;
  double clock_seconds_ = 0;
  std::optional<Exchange::Clock::time_point> clock_since_;

  double speed_ = 0, look_speed_ = 0;  // see Progress; kept from scene to scene
  double samples_per_second_ = 0, rays_per_second_ = 0;
  std::uint64_t serial_ = 0;

  WorkerPool pool_;  // last: its threads write to the films
};

}  // namespace lightbench
