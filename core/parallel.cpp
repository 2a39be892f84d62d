#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>

namespace lightbench {

unsigned processor_count() { return std::max(1U, std::thread::hardware_concurrency()); }

struct Team::Loop {
  const std::function<void(std::size_t)>* f;  ///< valid while an index is open
  std::size_t count;
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> failed{false};
  std::exception_ptr error;  ///< of the thread that set `failed`
  std::mutex mutex;
  std::condition_variable finished;
};

Team::Team(unsigned threads) {
  if (threads == 0) threads = processor_count();
  for (unsigned i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
}

Team::~Team() {
  const std::lock_guard lock(mutex_);
  closing_ = true;
  begun_.notify_all();
}

void Team::work(Loop& loop) {
  for (std::size_t i = loop.next++; i < loop.count; i = loop.next++) {
    try {
      if (!loop.failed) (*loop.f)(i);
    } catch (...) {
      if (!loop.failed.exchange(true)) loop.error = std::current_exception();
    }
    if (++loop.done < loop.count) continue;
    const std::lock_guard lock(loop.mutex);
    loop.finished.notify_all();
  }
}

void Team::help() {
  std::shared_ptr<Loop> last;
  for (;;) {
    std::unique_lock lock(mutex_);
    begun_.wait(lock, [&] { return closing_ || loop_ != last; });
    if (closing_) return;
    last = loop_;
    lock.unlock();
    work(*last);
  }
}

void Team::each(std::size_t count, const std::function<void(std::size_t)>& f) {
  const auto loop = std::make_shared<Loop>();
  loop->f = &f;
  loop->count = count;
  if (count > 1 && !helpers_.empty()) {
    const std::lock_guard lock(mutex_);
    loop_ = loop;
    begun_.notify_all();
  }
  work(*loop);
  std::unique_lock lock(loop->mutex);
  loop->finished.wait(lock, [&] { return loop->done == count; });
  if (loop->error != nullptr) std::rethrow_exception(loop->error);
}

void Team::runs(std::size_t count, std::size_t run,
                const std::function<void(std::size_t, std::size_t)>& f) {
  each((count + run - 1) / run, [&](std::size_t i) { f(i * run, std::min(count, (i + 1) * run)); });
}

}  // namespace lightbench
