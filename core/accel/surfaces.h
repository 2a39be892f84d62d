#pragma once
// A choice of the surfaces that the loop over a tiny scene tests.

#include "core/kernel/lanes.h"
#include "core/kernel/scene_view.h"

LIGHTBENCH_KERNEL_BEGIN

/// A flag for each surface of a scene without a tree.
struct Surfaces {
  std::uint8_t among[kTinyScene];
};

inline constexpr Surfaces kAllSurfaces = [] {
  Surfaces all{};
  for (std::uint8_t& flag : all.among) flag = 1;
  return all;
}();

LIGHTBENCH_KERNEL_END
