#pragma once
// Threads that trace one pass at a time, tile by tile.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/film/sample_plan.h"
#include "core/session/schedule.h"

namespace lightbench {

/// A pass over all of `film`, which must outlive it. A pass that starts at sample 0 clears each
/// tile first, so that a new picture does not wait for the whole film to be cleared.
struct Job {
  std::shared_ptr<const RenderScene> scene;
  FilmView film;
  int film_height = 0;
  Pass pass;
  Tiling tiling;
  /// If given, the counts of an adaptive picture, of whose present round `film` holds the sums. The
  /// pass that starts the round clears the tiles too.
  const SamplePlan* plan = nullptr;
  /// If given, receives the means after the pass, three floats per pixel: written tile by tile
  /// while the sums are at hand, since nobody traces while one thread goes over a whole film.
  float* means = nullptr;
};

/// What became of a job.
struct JobResult {
  bool complete = false;  ///< every pixel has every sample; else the film is of no use
  Counters counters;
  std::string error;  ///< one line, if tracing threw
};

/// Number of threads that `requested` means: 0 = all, negative = all minus that many, at least 1.
int thread_count(int requested);

/// Workers take tiles by an atomic counter and look for a cancel or hold between calls of render().
/// All methods are for one owner thread; `done` is called from a worker when a job ends. While
/// nothing runs or the job is held, the threads sleep.
class WorkerPool {
 public:
  WorkerPool(int threads, bool low_priority, std::function<void()> done);
  /// Cancels and joins.
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Only when no job runs: before the first and after `done` was called for the last.
  void start(Job job);
  /// Drops what has not begun; `done` follows within one call of render().
  void cancel();
  /// Suspends the workers between two calls of render(), and lets them go on.
  void hold(bool held);
  /// Of the job that ended last.
  [[nodiscard]] JobResult result() const;
  [[nodiscard]] int threads() const { return static_cast<int>(workers_.size()); }

 private:
  struct alignas(64) Worker {  // a cache line each, so that counting does not share
    Counters counters;
    std::vector<SampleRange> ranges;  // of a tile's pixels, adaptive pictures only
    std::thread thread;
  };

  void run(Worker& self, bool low_priority);
  void trace(Worker& self);
  /// False if the job was cancelled.
  bool trace_tile(Worker& self, std::int64_t tile);
  /// The samples of `work`, or those that the plan has for its pixels at these average counts.
  void trace_work(Worker& self, Work work);
  void write_tile_means(const Work& tile) const;
  /// True if the job goes on; sleeps while it is held.
  bool proceed();

  std::function<void()> done_;
  Job job_;                      // written by start() while no worker is active
  std::int64_t tile_count_ = 0;  // likewise
  std::atomic<std::int64_t> next_tile_{0};
  std::atomic<bool> interrupted_{false};  // held_ or cancelled_ or quit_, to ask without the mutex

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_;
  std::uint64_t job_number_ = 0;
  int active_ = 0;
  bool held_ = false;
  bool cancelled_ = false;
  bool quit_ = false;
  bool dropped_ = false;  // some work of the job was not done
  std::string error_;

  std::vector<Worker> workers_;  // last: the threads use all of the above
};

}  // namespace lightbench
