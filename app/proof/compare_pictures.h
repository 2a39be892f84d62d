#pragma once
// Do two ways of rendering have the same mean? Welch's test in every tile of a picture and over the
// whole of it; where they have, the p-values of the tiles are uniform (Jung, Hanika, Dachsbacher,
// "Detecting Bias in Monte Carlo Renderers using Welch's t-test", JCGT 9:2, 2020).

#include <cstdint>
#include <vector>

#include "app/proof/statistics.h"
#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

namespace lightbench::proof {

inline constexpr int kTile = 16;  ///< pixels a side
/// A standard error below this share of the mean is rounding.
inline constexpr double kStill = 1e-5;

/// Means over the tiles and over the picture of red + green + blue; the replicates are renders with
/// seeds of their own.
struct TiledPicture {
  std::vector<Mean> tiles;  ///< left to right, top to bottom; whole ones only
  int columns = 0;
  Mean whole;
};

/// `seeds` renders, the first with seed `first_seed`.
TiledPicture measure_tiles(Scene scene, KernelKind kernel, int spp, int seeds,
                           std::uint32_t first_seed);

/// With left and right exchanged.
TiledPicture mirrored(TiledPicture picture);

struct PictureComparison {
  std::vector<double> p;  ///< of the tiles where chance plays a part
  Welch whole;
  /// Largest relative difference over the other tiles (all of it seen directly, or dark).
  double still = 0;
};
/// `a` and `b` must not share seeds.
PictureComparison compare_pictures(const TiledPicture& a, const TiledPicture& b);

}  // namespace lightbench::proof
