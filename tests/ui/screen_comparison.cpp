#include "tests/ui/screen_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace lightbench::ui {
namespace {

constexpr int kCell = 4;
constexpr int kBlock = 32;

std::size_t offset(const Screen& screen, int x, int y) {
  return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(screen.width) +
              static_cast<std::size_t>(x));
}

std::vector<bool> masked_pixels(const Screen& screen, const std::vector<Rectangle>& masks) {
  std::vector<bool> masked(static_cast<std::size_t>(screen.width) *
                           static_cast<std::size_t>(screen.height));
  for (const Rectangle& mask : masks) {
    for (int y = std::max(0, mask.top); y < std::min(mask.bottom, screen.height); ++y) {
      for (int x = std::max(0, mask.left); x < std::min(mask.right, screen.width); ++x) {
        masked[offset(screen, x, y) / 3] = true;
      }
    }
  }
  return masked;
}

/// Largest difference of a channel's mean over the pixels of the square that are not masked.
double difference_of(const Screen& a, const Screen& b, const std::vector<bool>& masked,
                     const Rectangle& square) {
  std::array<double, 3> sum{};
  int count = 0;
  for (int y = square.top; y < square.bottom; ++y) {
    for (int x = square.left; x < square.right; ++x) {
      const std::size_t at = offset(a, x, y);
      if (masked[at / 3]) continue;
      ++count;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += double{1} * b.rgb[at + c] - a.rgb[at + c];
    }
  }
  double largest = 0;
  for (const double channel : sum) largest = std::max(largest, std::abs(channel));
  return count > 0 ? largest / count : 0;
}

}  // namespace

Screen crop(const Screen& screen, const Rectangle& part) {
  Screen result{part.right - part.left, part.bottom - part.top, {}};
  for (int y = part.top; y < part.bottom; ++y) {
    const auto row = screen.rgb.begin() + static_cast<std::ptrdiff_t>(offset(screen, part.left, y));
    result.rgb.insert(result.rgb.end(), row, row + std::ptrdiff_t{3} * result.width);
  }
  return result;
}

ScreenComparison compare_screens(const Screen& expected, const Screen& actual,
                                 const std::vector<Rectangle>& masks) {
  ScreenComparison result;
  result.picture = actual;
  if (expected.width != actual.width || expected.height != actual.height) {
    result.difference = "the sizes differ";
    return result;
  }
  const std::vector<bool> masked = masked_pixels(actual, masks);
  std::vector<std::uint8_t>& shown = result.picture.rgb;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    shown[i] = static_cast<std::uint8_t>(shown[i] / 2 + (masked[i / 3] && i % 3 == 2 ? 96 : 0));
  }
  const int width = actual.width;
  const int height = actual.height;
  int count = 0;
  double worst = 0;
  Rectangle all{width, height, 0, 0};
  for (const auto& [edge, tolerance] :
       {std::pair{kCell, kCellTolerance}, std::pair{kBlock, kBlockTolerance}}) {
    for (int top = 0; top < height; top += edge) {
      for (int left = 0; left < width; left += edge) {
        const Rectangle square{left, top, std::min(left + edge, width),
                               std::min(top + edge, height)};
        const double difference = difference_of(expected, actual, masked, square);
        if (difference <= tolerance) continue;
        ++count;
        worst = std::max(worst, difference);
        all = {std::min(all.left, square.left), std::min(all.top, square.top),
               std::max(all.right, square.right), std::max(all.bottom, square.bottom)};
        for (int y = square.top; y < square.bottom; ++y) {
          for (int x = square.left; x < square.right; ++x) shown[offset(actual, x, y)] |= 0xa0U;
        }
      }
    }
  }
  if (count > 0) {
    result.difference = std::to_string(count) + " squares differ, by up to " +
                        std::to_string(std::lround(worst)) + " of 255, all within (" +
                        std::to_string(all.left) + ", " + std::to_string(all.top) + ") to (" +
                        std::to_string(all.right) + ", " + std::to_string(all.bottom) + ")";
  }
  return result;
}

}  // namespace lightbench::ui
