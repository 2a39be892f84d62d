#include "core/session/priority.h"

#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>

namespace lightbench {
namespace {

/// The kernel's struct sched_attr, first version; Debian 12's C library has none.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes), policy = 0;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0, deadline = 0, period = 0;  ///< nanoseconds
};

constexpr std::uint64_t kShortestSlice = 100'000;  // that Linux grants
constexpr std::uint64_t kResetOnFork = 1;          // threads that this one makes are as ever

}  // namespace

void lower_priority() {
  const sched_param none{};
  (void)sched_setscheduler(0, SCHED_BATCH, &none);
  (void)setpriority(PRIO_PROCESS, 0, 10);
}

void react_promptly() {
  SchedulingAttributes attributes;
  if (syscall(SYS_sched_getattr, 0, &attributes, sizeof attributes, 0) != 0) return;
  attributes.flags |= kResetOnFork;
  attributes.runtime = kShortestSlice;
  (void)syscall(SYS_sched_setattr, 0, &attributes, 0);
}

}  // namespace lightbench
