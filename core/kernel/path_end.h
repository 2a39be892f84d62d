#pragma once

namespace lightbench {

/// Why a path ends.
enum class PathEnd {
  Escaped,       ///< left the scene
  Depth,         ///< as long as the scene allows
  Black,         ///< met a surface that reflects nothing
  Absorbed,      ///< the sampled direction carries no light (below the surface)
  Roulette,      ///< Russian roulette
  NoThroughput,  ///< everything on the way absorbs it
};

}  // namespace lightbench
