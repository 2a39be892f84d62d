#pragma once
// Loops over threads, for work that is done once in a while: compiling large scenes.

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace lightbench {

/// Threads of this machine, at least 1.
unsigned processor_count();

/// Threads that share loops with the one that calls. They help where they can: on a busy machine a
/// loop never waits for a thread that has not begun with it.
class Team {
 public:
  /// `threads` counts the caller; 0: the processor's.
  explicit Team(unsigned threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls f(0), ..., f(count - 1), each once, in any order; the next index goes to whoever is
  /// free. Returns when all are done; rethrows the first exception, after which no further call is
  /// begun.
  void each(std::size_t count, const std::function<void(std::size_t)>& f);

  /// The same over [0, count) in runs [begin, end) of at most `run`.
  void runs(std::size_t count, std::size_t run,
            const std::function<void(std::size_t begin, std::size_t end)>& f);

 private:
  struct Loop;
  void help();
  static void work(Loop& loop);

  std::mutex mutex_;
  std::condition_variable begun_;
  std::shared_ptr<Loop> loop_;  ///< the latest; helpers that come late find it finished
  bool closing_ = false;
  std::vector<std::jthread> helpers_;
};

}  // namespace lightbench
