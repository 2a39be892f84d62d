#pragma once
// A loop over independent pieces of work on several threads.

#include <algorithm>
#include <cstdint>

#include "core/parallel.h"

namespace lightbench {

/// Runs f(i) for all i in [begin, end) on so many threads, this one among them; the first exception
/// ends the loop and is thrown again.
template <class F>
void for_each_on_threads(std::uint64_t begin, std::uint64_t end, int threads, F f) {
  Team team(static_cast<unsigned>(std::max(threads, 1)));
  team.each(end - begin, [&](std::size_t i) { f(begin + i); });
}

}  // namespace lightbench
