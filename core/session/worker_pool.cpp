#include "core/session/worker_pool.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/session/priority.h"

namespace lightbench {
namespace {

void clear_tile(FilmView film, const Work& tile) {
  for (int y = tile.y0; y < tile.y1; ++y) {
    FilmPixel* row = film.pixels + static_cast<std::ptrdiff_t>(y) * film.width;
    std::fill(row + tile.x0, row + tile.x1, FilmPixel{});
  }
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
  const std::uint32_t start = job_.plan == nullptr ? 0 : job_.plan->round();
  if (job_.pass.first_sample == start) clear_tile(job_.film, work);
  const std::uint32_t end = job_.pass.first_sample + job_.pass.sample_count;
  for (std::uint32_t sample = job_.pass.first_sample; sample < end;) {
    if (interrupted_.load(std::memory_order_relaxed) && !proceed()) return false;
    work.first_sample = sample;
    work.sample_count = std::min(job_.tiling.samples, end - sample);
    trace_work(self, work);
    sample += work.sample_count;
  }
  if (job_.means != nullptr) write_tile_means(work);
  return true;
}

void WorkerPool::trace_work(Worker& self, Work work) {
  if (job_.plan != nullptr) {
    const std::uint32_t from = work.first_sample, to = from + work.sample_count;
    self.ranges.clear();
    for (int y = work.y0; y < work.y1; ++y) {
      for (int x = work.x0; x < work.x1; ++x) {
        const std::ptrdiff_t pixel = static_cast<std::ptrdiff_t>(y) * job_.film.width + x;
        self.ranges.push_back(job_.plan->range(static_cast<std::size_t>(pixel), from, to));
      }
    }
    work.ranges = self.ranges.data();
  }
  render(*job_.scene, work, job_.film, self.counters);
}

void WorkerPool::write_tile_means(const Work& tile) const {
  const std::uint32_t spp = job_.pass.first_sample + job_.pass.sample_count;
  const auto count = static_cast<std::size_t>(tile.x1 - tile.x0);
  for (int y = tile.y0; y < tile.y1; ++y) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(y) * job_.film.width + tile.x0;
    const FilmPixel* sums = job_.film.pixels + first;
    float* means = job_.means + 3 * first;
    if (job_.plan == nullptr) {
      write_means(sums, count, job_.scene->film_unit, spp, means);
    } else {
      job_.plan->write_means(sums, static_cast<std::size_t>(first), count, job_.scene->film_unit,
                             spp, means);
    }
  }
}

bool WorkerPool::proceed() {
  std::unique_lock lock(mutex_);
  wake_.wait(lock, [&] { return !held_ || cancelled_ || quit_; });
  if (!cancelled_ && !quit_) return true;
  dropped_ = true;
  return false;
}

}  // namespace lightbench
