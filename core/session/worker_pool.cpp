#include "core/session/worker_pool.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <utility>

namespace lightbench {
namespace {

// On Linux both apply to the calling thread. Failing leaves a thread of normal priority: harmless.
void lower_priority() {
  const sched_param none{};
  (void)sched_setscheduler(0, SCHED_BATCH, &none);
  (void)setpriority(PRIO_PROCESS, 0, 10);
}

int tiles_across(int size, int edge) { return (size + edge - 1) / edge; }

}  // namespace

int thread_count(int requested) {
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return requested > 0 ? requested : std::max(1, all + requested);
}

WorkerPool::WorkerPool(int threads, bool low_priority, std::function<void()> done)
    : done_(std::move(done)), workers_(static_cast<std::size_t>(std::max(1, threads))) {
  for (Worker& worker : workers_) {
    worker.thread = std::thread([this, &worker, low_priority] { run(worker, low_priority); });
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
    interrupted_ = true;
  }
  wake_.notify_all();
  for (Worker& worker : workers_) worker.thread.join();
}

void WorkerPool::start(Job job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
    const int edge = job_.tiling.edge;
    tile_count_ =
        std::int64_t{tiles_across(job_.film.width, edge)} * tiles_across(job_.film_height, edge);
    next_tile_ = 0;
    cancelled_ = false;
    dropped_ = false;
    error_.clear();
    interrupted_ = held_ || quit_;
    active_ = threads();
    ++job_number_;
    for (Worker& worker : workers_) worker.counters = {};
  }
  wake_.notify_all();
}

void WorkerPool::cancel() {
  {
    const std::lock_guard lock(mutex_);
    cancelled_ = true;
    interrupted_ = true;
  }
  wake_.notify_all();
}

void WorkerPool::hold(bool held) {
  {
    const std::lock_guard lock(mutex_);
    held_ = held;
    interrupted_ = held_ || cancelled_ || quit_;
  }
  wake_.notify_all();
}

JobResult WorkerPool::result() const {
  const std::lock_guard lock(mutex_);
  JobResult result{!dropped_ && error_.empty(), {}, error_};
  for (const Worker& worker : workers_) result.counters += worker.counters;
  return result;
}

void WorkerPool::run(Worker& self, bool low_priority) {
  if (low_priority) lower_priority();
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return quit_ || job_number_ != seen; });
      if (quit_) return;
      seen = job_number_;
    }
    try {
      trace(self);
    } catch (const std::exception& e) {
      const std::lock_guard lock(mutex_);
      error_ = e.what();
      cancelled_ = true;
      interrupted_ = true;
    }
    bool last = false;
    {
      const std::lock_guard lock(mutex_);
      last = --active_ == 0;
    }
    if (last) done_();
  }
}

void WorkerPool::trace(Worker& self) {
  for (;;) {
    const std::int64_t tile = next_tile_.fetch_add(1, std::memory_order_relaxed);
    if (tile >= tile_count_ || !trace_tile(self, tile)) return;
  }
}

bool WorkerPool::trace_tile(Worker& self, std::int64_t tile) {
  const int edge = job_.tiling.edge;
  const int columns = tiles_across(job_.film.width, edge);
  Work work;
  work.x0 = static_cast<int>(tile % columns) * edge;
  work.y0 = static_cast<int>(tile / columns) * edge;
  work.x1 = std::min(work.x0 + edge, job_.film.width);
  work.y1 = std::min(work.y0 + edge, job_.film_height);
  work.stride = job_.pass.divider;
  if (job_.pass.first_sample == 0) {
    for (int y = work.y0; y < work.y1; ++y) {
      FilmPixel* row = job_.film.pixels + static_cast<std::ptrdiff_t>(y) * job_.film.width;
      std::fill(row + work.x0, row + work.x1, FilmPixel{});
    }
  }
  const std::uint32_t end = job_.pass.first_sample + job_.pass.sample_count;
  for (std::uint32_t sample = job_.pass.first_sample; sample < end;) {
    if (interrupted_.load(std::memory_order_relaxed) && !proceed()) return false;
    work.first_sample = sample;
    work.sample_count = std::min(job_.tiling.samples, end - sample);
    render(*job_.scene, work, job_.film, self.counters);
    sample += work.sample_count;
  }
  for (int y = work.y0; y < work.y1 && job_.means != nullptr; ++y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * job_.film.width + work.x0;
    write_means(job_.film.pixels + first, static_cast<std::size_t>(work.x1 - work.x0),
                job_.scene->film_unit, end, job_.means + 3 * first);
  }
  return true;
}

bool WorkerPool::proceed() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return !held_ || cancelled_ || quit_; });
  if (!cancelled_ && !quit_) return true;
  dropped_ = true;
  return false;
}

}  // namespace lightbench
