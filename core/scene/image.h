#pragma once
// Pixels in memory: what a texture reads and what an image file holds.

#include <cstddef>
#include <vector>

namespace lightbench {

/// Linear RGB radiance or reflectance (Rec. 709 primaries), three floats per pixel, top row first.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> rgb;

  [[nodiscard]] std::size_t pixel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

}  // namespace lightbench
