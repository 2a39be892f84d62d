#include "app/image_difference.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace lightbench {

ImageDifference difference(const Image& picture, const Image& reference) {
  ImageDifference result;
  const std::size_t pixels = picture.pixel_count();
  std::vector<double> relative(pixels);  // summed over the channels
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    const double a = picture.rgb[i], b = reference.rgb[i];
    if (!std::isfinite(a) || !std::isfinite(b)) {
      ++result.non_finite;
      continue;
    }
    const double d = a - b;
    result.mse += d * d;
    relative[i / 3] += d * d / (b * b + kRelativeFloor);
    result.mean[i % 3] += d;
    if (std::abs(d) > result.max) {
      result.max = std::abs(d);
      const auto pixel = static_cast<int>(i / 3);
      result.max_x = pixel % picture.width;
      result.max_y = pixel / picture.width;
    }
  }
  const auto values = static_cast<double>(std::max<std::size_t>(1, picture.rgb.size()));
  result.mse /= values;
  for (double& mean : result.mean) mean *= 3 / values;
  for (const double r : relative) result.relmse += r;
  const std::size_t worst = pixels / 1000;
  const auto cut = relative.begin() + static_cast<std::ptrdiff_t>(worst);
  std::nth_element(relative.begin(), cut, relative.end(), std::greater<>());
  double dropped = 0;
  for (auto r = relative.begin(); r != cut; ++r) dropped += *r;
  const auto kept = static_cast<double>(std::max<std::size_t>(1, 3 * (pixels - worst)));
  result.trimmed_relmse = std::max(0.0, result.relmse - dropped) / kept;
  result.relmse /= values;
  return result;
}

}  // namespace lightbench
