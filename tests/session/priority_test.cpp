// What threads ask of the system's scheduler.

#include "core/session/priority.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <thread>

namespace lightbench {
namespace {

/// The calling thread's slice in nanoseconds; 0 where the system has none.
std::uint64_t slice() {
  std::uint64_t attributes[6] = {};  // struct sched_attr: the fourth is sched_runtime
  if (syscall(SYS_sched_getattr, 0, attributes, sizeof attributes, 0) != 0) return 0;
  return attributes[3];
}

template <class F>
void in_a_thread(F f) {
  std::thread(f).join();
}

TEST(Priority, ShortSlicesAreNotInherited) {
  in_a_thread([] {
    const std::uint64_t before = slice();
    if (before == 0) GTEST_SKIP() << "this system has no slices of a thread's own";
    react_promptly();
    EXPECT_LT(slice(), before);
    in_a_thread([before] { EXPECT_EQ(slice(), before); });
  });
}

TEST(Priority, PromptThreadsKeepTheirPriority) {
  in_a_thread([] {
    const int before = getpriority(PRIO_PROCESS, 0);
    react_promptly();
    EXPECT_EQ(getpriority(PRIO_PROCESS, 0), before);
    EXPECT_EQ(sched_getscheduler(0) & ~SCHED_RESET_ON_FORK, SCHED_OTHER);
  });
}

TEST(Priority, LowIsLow) {
  in_a_thread([] {
    lower_priority();
    EXPECT_GE(getpriority(PRIO_PROCESS, 0), 10);
    EXPECT_EQ(sched_getscheduler(0), SCHED_BATCH);
  });
}

}  // namespace
}  // namespace lightbench
