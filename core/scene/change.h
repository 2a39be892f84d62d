#pragma once
// What an edit touched. Edits are detected by comparing values, so no widget can forget to say.

#include <cstdint>

#include "core/scene/scene.h"

namespace lightbench {

enum class Change : std::uint32_t {
  None = 0,
  Display = 1 << 0,     ///< exposure, tone map, names: no pixel of the render changes
  Target = 1 << 1,      ///< spp, time limit, snapshots: the render continues
  Settings = 1 << 2,    ///< depth, strategy, seed, filter, adaptive
  Resolution = 1 << 3,  ///< width, height, crop
  Camera = 1 << 4,
  Environment = 1 << 5,
  Materials = 1 << 6,  ///< material or medium values, which object uses which, emission
  Textures = 1 << 7,
  Transforms = 1 << 8,  ///< object transforms
  Geometry = 1 << 9,    ///< shapes, visibility, number of objects
  Meshes = 1 << 10,     ///< mesh payloads
  All = (1 << 11) - 1,
};
constexpr Change operator|(Change a, Change b) {
  return static_cast<Change>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr Change operator&(Change a, Change b) {
  return static_cast<Change>(static_cast<std::uint32_t>(a) & static_cast<std::uint32_t>(b));
}
constexpr Change& operator|=(Change& a, Change b) { return a = a | b; }
constexpr bool any(Change c) { return c != Change::None; }

/// True if accumulated samples are no longer valid after such a change.
constexpr bool resets_film(Change c) {
  return any(c & static_cast<Change>(~static_cast<std::uint32_t>(Change::Display | Change::Target) &
                                     static_cast<std::uint32_t>(Change::All)));
}

/// Compares field by field; payloads by pointer. O(objects), no allocation.
Change diff(const Scene& before, const Scene& after);

}  // namespace lightbench
