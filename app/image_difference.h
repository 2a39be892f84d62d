#pragma once
// How far one picture is from another.

#include <array>
#include <cstddef>
#include <vector>

#include "core/scene/image.h"

namespace lightbench {

/// The floor that keeps relative errors of dark pixels finite.
inline constexpr double kRelativeFloor = 0.01;

/// Over all pixels and the three channels, of linear values a (picture) and b (reference).
struct ImageDifference {
  double mse = 0;
  double relmse = 0;          ///< mean of (a - b)^2 / (b^2 + kRelativeFloor)
  double trimmed_relmse = 0;  ///< the same without the worst thousandth of the pixels
  double max = 0;             ///< largest |a - b|
  int max_x = 0, max_y = 0;
  std::array<double, 3> mean{};  ///< of a - b per channel: bias, where noise cancels
  std::size_t non_finite = 0;    ///< values that are NaN or infinite in either image

  /// Mean of a - b over the channels.
  [[nodiscard]] double bias() const { return (mean[0] + mean[1] + mean[2]) / 3; }
};

/// Both images must have the same size.
ImageDifference difference(const Image& picture, const Image& reference);

}  // namespace lightbench
