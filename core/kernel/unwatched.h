#pragma once
// What the steps of a path report to is a template parameter; core/query/path_watch.h has the one
// that writes a path down.

#include "core/kernel/lanes.h"

LIGHTBENCH_KERNEL_BEGIN

/// Takes no reports and costs nothing.
struct Unwatched {
  static constexpr bool kOn = false;
};

LIGHTBENCH_KERNEL_END
