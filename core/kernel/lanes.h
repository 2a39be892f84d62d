#pragma once
// The number types of the kernel: Real, Int (unsigned 32-bit), Mask, each holding kLanes values,
// and the few operations the renderer needs on them. Everything that core/kernel/render.h includes
// is written once over these and compiled for each target: one float (scalar), one double
// (reference), 8 and 16 floats, 4 and 8 doubles.
//
// A target's translation unit defines LIGHTBENCH_TARGET (namespace), LIGHTBENCH_LANES and, for
// double, LIGHTBENCH_DOUBLE. All code sits in an unnamed namespace inside the target's, so that the
// linker can never merge a function compiled for one instruction set into another.
//
// The float targets give bit-identical results, and so do the double ones: same operations, exact
// division and square root, no contraction (-ffp-contract=off); fused multiply-adds are written by
// name.

#ifndef LIGHTBENCH_TARGET
#error "include from a target translation unit (core/kernel/target_*.cpp)"
#endif

#define LIGHTBENCH_KERNEL_BEGIN \
  namespace lightbench {        \
  namespace LIGHTBENCH_TARGET { \
  namespace {
#define LIGHTBENCH_KERNEL_END \
  }                           \
  }                           \
  }

#if LIGHTBENCH_LANES == 1
#include "core/kernel/lanes_scalar.h"
#elif defined(LIGHTBENCH_DOUBLE)
#include "core/kernel/lanes_x86_double.h"
#else
#include "core/kernel/lanes_x86.h"
#endif

LIGHTBENCH_KERNEL_BEGIN
/// Whether the target has 32 registers for lanes (AVX-512) rather than 16.
inline constexpr bool kManyRegisters = sizeof(T) * kLanes == 64;
LIGHTBENCH_KERNEL_END

#ifdef LIGHTBENCH_DOUBLE
#include "core/kernel/elementary_double.h"
#else
#include "core/kernel/elementary_float.h"
#endif

LIGHTBENCH_KERNEL_BEGIN

inline constexpr std::uint32_t kLaneNumbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                   8, 9, 10, 11, 12, 13, 14, 15};

LIGHTBENCH_KERNEL_END
