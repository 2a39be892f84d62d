#pragma once
// Whether two pictures of the interface look the same to a person. Antialiasing that differs
// between releases of Mesa or of a rasterizer passes; a panel that moves by a pixel, vanishes,
// changes its grey or clips a letter does not.

#include <cstdint>
#include <string>
#include <vector>

namespace lightbench::ui {

/// 8-bit RGB, top row first.
struct Screen {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Pixels: left and top inside, right and bottom outside.
struct Rectangle {
  int left, top, right, bottom;
};

Screen crop(const Screen& screen, const Rectangle& part);

struct ScreenComparison {
  /// Empty if they look the same; else how many cells differ, by how much, and the pixels that
  /// hold all of them.
  std::string difference;
  /// The actual screen, darkened, with what differs in red and what is masked in blue.
  Screen picture;
};

/// Means of cells of 4 x 4 pixels may differ by kCellTolerance of 255, of 32 x 32 by
/// kBlockTolerance; the largest channel decides. Pixels in `masks` do not count.
ScreenComparison compare_screens(const Screen& expected, const Screen& actual,
                                 const std::vector<Rectangle>& masks);

/// Measured on this interface: text drawn a fifth of a pixel aside changes cells by 8 and blocks by
/// 0.2; one pixel aside, cells by 40. One letter gone: cells by 59. The next grey of the theme:
/// blocks by 2.
inline constexpr double kCellTolerance = 16;
inline constexpr double kBlockTolerance = 1.5;

}  // namespace lightbench::ui
