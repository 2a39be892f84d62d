#include "app/proof/compare_pictures.h"

#include <algorithm>
#include <cmath>

#include "app/proof/measure.h"

namespace lightbench::proof {
namespace {

bool is_still(const Mean& a, const Mean& b) {
  return std::hypot(a.error, b.error) <= kStill * std::max(std::abs(a.value), std::abs(b.value));
}

}  // namespace

TiledPicture measure_tiles(Scene scene, KernelKind kernel, int spp, int seeds,
                           std::uint32_t first_seed) {
  std::vector<std::vector<double>> tiles;
  std::vector<double> whole;
  int columns = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    scene.render.seed = first_seed + static_cast<std::uint32_t>(seed);
    const Film film = render_film(scene, kernel, spp);
    const auto width = static_cast<std::size_t>(film.width());
    const auto height = static_cast<std::size_t>(film.height());
    const std::size_t across = width / kTile, down = height / kTile;
    columns = static_cast<int>(across);
    tiles.resize(across * down);
    for (auto& tile : tiles) tile.push_back(0);
    whole.push_back(0);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const glm::dvec3 c = pixel_mean(film, y * width + x, spp);
        const double value = c.x + c.y + c.z;
        whole.back() += value / static_cast<double>(width * height);
        const std::size_t column = x / kTile, row = y / kTile;
        if (column < across && row < down) {
          tiles[row * across + column].back() += value / (kTile * kTile);
        }
      }
    }
  }
  TiledPicture picture;
  picture.columns = columns;
  for (const auto& tile : tiles) picture.tiles.push_back(mean_of(tile));
  picture.whole = mean_of(whole);
  return picture;
}

TiledPicture mirrored(TiledPicture picture) {
  for (auto row = picture.tiles.begin(); row != picture.tiles.end(); row += picture.columns) {
    std::reverse(row, row + picture.columns);
  }
  return picture;
}

PictureComparison compare_pictures(const TiledPicture& a, const TiledPicture& b) {
  PictureComparison result;
  const auto still = [&](const Mean& x, const Mean& y) {
    const double size = std::max(std::abs(x.value), std::abs(y.value));
    if (size > 0) result.still = std::max(result.still, std::abs(x.value - y.value) / size);
  };
  for (std::size_t i = 0; i < a.tiles.size(); ++i) {
    if (is_still(a.tiles[i], b.tiles[i])) {
      still(a.tiles[i], b.tiles[i]);
    } else {
      result.p.push_back(welch(a.tiles[i], b.tiles[i]).p);
    }
  }
  if (is_still(a.whole, b.whole)) {
    still(a.whole, b.whole);
  } else {
    result.whole = welch(a.whole, b.whole);
  }
  return result;
}

}  // namespace lightbench::proof
