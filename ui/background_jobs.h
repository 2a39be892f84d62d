#pragma once
// Work that would hold up a frame (files) runs here; its result comes back to the UI thread.

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace lightbench::ui {

/// One worker thread. run() and finish() are called by the UI thread; jobs run in order. The
/// destructor waits for the jobs already queued, so that no file is lost.
class BackgroundJobs {
 public:
  /// What a job leaves for the UI thread to do.
  using Finish = std::function<void()>;

  /// `wake` is called from the worker when a result waits; `report` on the UI thread with the
  /// message of a job that threw.
  BackgroundJobs(std::function<void()> wake, std::function<void(const std::string&)> report);
  ~BackgroundJobs();
  BackgroundJobs(const BackgroundJobs&) = delete;
  BackgroundJobs& operator=(const BackgroundJobs&) = delete;

  void run(std::function<Finish()> job);
  /// Runs what finished jobs left. True if there was any.
  bool finish();
  /// Jobs queued or running, plus results not yet taken.
  [[nodiscard]] int pending() const { return pending_; }

 private:
  void work();

  std::function<void()> wake_;
  std::function<void(const std::string&)> report_;
  std::mutex mutex_;  // guards jobs_, results_, stopping_
  std::condition_variable changed_;
  std::deque<std::function<Finish()>> jobs_;
  std::deque<Finish> results_;
  bool stopping_ = false;
  std::atomic<int> pending_{0};
  std::thread worker_;
};

}  // namespace lightbench::ui
