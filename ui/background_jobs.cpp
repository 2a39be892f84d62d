#include "ui/background_jobs.h"

#include <exception>
#include <utility>

namespace lightbench::ui {

BackgroundJobs::BackgroundJobs(std::function<void()> wake,
                               std::function<void(const std::string&)> report)
    : wake_(std::move(wake)), report_(std::move(report)), worker_([this] { work(); }) {}

BackgroundJobs::~BackgroundJobs() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void BackgroundJobs::run(std::function<Finish()> job) {
  ++pending_;
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
}

bool BackgroundJobs::finish() {
  std::deque<Finish> ready;
  {
    const std::lock_guard lock(mutex_);
    ready.swap(results_);
  }
  for (const Finish& result : ready) {
    --pending_;
    if (result) result();
  }
  return !ready.empty();
}

void BackgroundJobs::work() {
  for (;;) {
    std::function<Finish()> job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    Finish result;
    try {
      result = job();
    } catch (const std::exception& error) {
      result = [this, message = std::string(error.what())] { report_(message); };
    }
    {
      const std::lock_guard lock(mutex_);
      results_.push_back(std::move(result));
    }
    wake_();
  }
}

}  // namespace lightbench::ui
