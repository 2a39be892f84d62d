#include "core/film/film.h"

#include <algorithm>
#include <new>
#include <string>

#include "core/error.h"

namespace lightbench {
namespace {

// 4 GiB of film; anything larger is a typing error rather than a picture.
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 27;

constexpr double kStep = 1.0 / static_cast<double>(std::int64_t{1} << kFilmBits);
constexpr double kSquareStep = 1.0 / static_cast<double>(std::int64_t{1} << kFilmSquareBits);

// Rec. 709, as in the kernel that sums squared luminance.
double luminance(const FilmPixel& sum) {
  return 0.2126 * static_cast<double>(sum.r) + 0.7152 * static_cast<double>(sum.g) +
         0.0722 * static_cast<double>(sum.b);
}

}  // namespace

Film::Film(int width, int height, double unit) : width_(width), height_(height), unit_(unit) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width <= 0 || height <= 0) {
    throw Error(ErrorKind::Usage, "resolution " + size + ": expected a width and height above 0");
  }
  const std::int64_t count = std::int64_t{width} * height;
  if (count > kMaxPixels) {
    throw Error(ErrorKind::Usage, "resolution " + size + ": expected at most " +
                                      std::to_string(kMaxPixels) + " pixels");
  }
  try {
    pixels_.resize(static_cast<std::size_t>(count));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::Usage, "resolution " + size + ": not enough memory for the film");
  }
}

void Film::clear() { std::fill(pixels_.begin(), pixels_.end(), FilmPixel{}); }

void write_means(const FilmPixel* pixels, std::size_t count, double unit, std::uint32_t spp,
                 float* rgb) {
  const double scale = unit * kStep / spp;
  for (const FilmPixel* sum = pixels; sum != pixels + count; ++sum) {
    *rgb++ = static_cast<float>(scale * static_cast<double>(sum->r));
    *rgb++ = static_cast<float>(scale * static_cast<double>(sum->g));
    *rgb++ = static_cast<float>(scale * static_cast<double>(sum->b));
  }
}

Moments moments(const FilmPixel& sum, double count) {
  const double first = kStep * luminance(sum);
  const double second = kSquareStep * static_cast<double>(sum.luminance_squared);
  return {first / count, std::max(0.0, (second - first * first / count) / (count - 1))};
}

Image Film::mean(std::uint32_t spp) const {
  Image image{width_, height_, std::vector<float>(3 * pixels_.size())};
  if (spp > 0) write_means(pixels_.data(), pixels_.size(), unit_, spp, image.rgb.data());
  return image;
}

std::vector<float> Film::variance(std::uint32_t spp) const {
  std::vector<float> variance(pixels_.size());
  if (spp < 2) return variance;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    variance[i] = static_cast<float>(unit_ * unit_ * moments(pixels_[i], spp).variance);
  }
  return variance;
}

std::uint64_t Film::hash() const {
  std::uint64_t h = 0xcbf29ce484222325U;
  const auto mix = [&h](std::int64_t value) {
    auto bits = static_cast<std::uint64_t>(value);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) h = (h ^ (bits & 0xffU)) * 0x100000001b3U;
  };
  for (const FilmPixel& sum : pixels_) {
    mix(sum.r);
    mix(sum.g);
    mix(sum.b);
    mix(sum.luminance_squared);
  }
  return h;
}

}  // namespace lightbench
