#pragma once
// A loop over independent pieces of work on several threads.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lightbench {

/// Runs f(i) for all i in [begin, end) on so many threads, this one among them; the first exception
/// ends the loop and is thrown again.
template <class F>
void for_each_on_threads(std::uint64_t begin, std::uint64_t end, int threads, F f) {
  std::atomic<std::uint64_t> next{begin};
  std::exception_ptr error;
  std::mutex mutex;
  const auto work = [&] {
    for (;;) {
      const std::uint64_t i = next++;
      if (i >= end) return;
      try {
        f(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
        next = end;
      }
    }
  };
  std::vector<std::jthread> others;
  const auto most = static_cast<std::uint64_t>(std::max(threads, 1));
  for (std::uint64_t k = 1; k < std::min(most, end - begin); ++k) others.emplace_back(work);
  work();
  others.clear();
  if (error) std::rethrow_exception(error);
}

}  // namespace lightbench
