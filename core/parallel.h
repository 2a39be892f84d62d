#pragma once
// A loop over threads, for work that is done once in a while: compiling large scenes.

#include <cstddef>
#include <functional>

namespace lightbench {

/// Threads of this machine, at least 1.
unsigned processor_count();

/// Calls f(0), ..., f(count - 1), each once, on up to `threads` threads, the caller's among them;
/// in any order, the next index to whoever is free. Returns when all are done; rethrows the first
/// exception, after which no further index is begun.
void parallel_for(unsigned threads, std::size_t count, const std::function<void(std::size_t)>& f);

/// The same over [0, count) in runs [begin, end) of at most `run`.
void parallel_runs(unsigned threads, std::size_t count, std::size_t run,
                   const std::function<void(std::size_t begin, std::size_t end)>& f);

}  // namespace lightbench
