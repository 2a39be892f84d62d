#pragma once
// The pixels that textures and environments read.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/scene/image.h"

namespace lightbench {

/// Linear RGB (Rec. 709 primaries), top row first, at the full precision of the image that it was
/// made of. An image of at most 256 different values, as those of all 8-bit files are, is held as
/// their numbers: a third of the memory, and one fetch per texel where there were three.
struct Texels {
  int width = 0, height = 0;
  std::vector<float> rgb;             ///< three per texel; empty if `packed` holds the image
  std::vector<std::uint32_t> packed;  ///< numbers of red (low byte), green and blue, or empty
  std::vector<float> values;          ///< of the numbers, 256; empty if `rgb` holds the image

  bool operator==(const Texels&) const = default;
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  /// Of texel y * width + x.
  [[nodiscard]] std::array<float, 3> color(std::size_t i) const {
    if (packed.empty()) return {rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]};
    return {values[packed[i] & 255U], values[packed[i] >> 8 & 255U], values[packed[i] >> 16]};
  }
};

/// Values must not be NaN.
Texels make_texels(Image image);

}  // namespace lightbench
