#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace lightbench {

unsigned processor_count() { return std::max(1U, std::thread::hardware_concurrency()); }

void parallel_for(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& f) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) f(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(error_mutex);
      if (error == nullptr) error = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < std::min<std::size_t>(threads, count); ++i) others.emplace_back(work);
  work();
  others.clear();  // joins
  if (error != nullptr) std::rethrow_exception(error);
}

void parallel_runs(unsigned threads, std::size_t count, std::size_t run,
                   const std::function<void(std::size_t, std::size_t)>& f) {
  parallel_for(threads, (count + run - 1) / run,
               [&](std::size_t i) { f(i * run, std::min(count, (i + 1) * run)); });
}

}  // namespace lightbench
