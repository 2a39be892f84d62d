// The two formats simple enough to write by hand: PPM (P6) and PFM (Debevec's portable float map).

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "core/film/image_formats.h"
#include "core/film/tone_map.h"

namespace lightbench {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Words of the header, then the pixels after exactly one white space.
class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes) : rest_(bytes) {}

  std::string_view word() {
    while (!rest_.empty() && (is_space(rest_[0]) || rest_[0] == '#')) {
      const std::size_t skipped = rest_[0] == '#' ? std::min(rest_.find('\n'), rest_.size()) : 1;
      rest_.remove_prefix(skipped);
    }
    std::size_t length = 0;
    while (length < rest_.size() && !is_space(rest_[length])) ++length;
    const std::string_view result = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return result;
  }
  template <class T>
  T number() {
    const std::string_view text = word();
    T value{};
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || end != text.data() + text.size())
      throw std::runtime_error("expected a number in the header");
    return value;
  }
  std::string_view pixels(std::size_t size) {
    if (rest_.empty() || rest_.size() - 1 < size)
      throw std::runtime_error("the file ends too early");
    return rest_.substr(1, size);
  }

 private:
  std::string_view rest_;
};

std::string header(const char* magic, int width, int height, const char* last) {
  return std::string(magic) + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
         last + "\n";
}

float float_at(std::string_view bytes, std::size_t index, bool big_endian) {
  std::array<char, 4> value{};
  std::memcpy(value.data(), bytes.data() + 4 * index, 4);
  if (big_endian == (std::endian::native == std::endian::little)) {
    std::swap(value[0], value[3]);
    std::swap(value[1], value[2]);
  }
  return std::bit_cast<float>(value);
}

}  // namespace

std::string encode_ppm(const ByteImage& image) {
  std::string bytes = header("P6", image.width, image.height, "255");
  bytes.append(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size());
  return bytes;
}

Image decode_ppm(std::string_view bytes, bool srgb) {
  HeaderReader reader(bytes);
  reader.word();
  Image image;
  image.width = reader.number<int>();
  image.height = reader.number<int>();
  const int largest = reader.number<int>();
  check_image_size(image.width, image.height, bytes.size());
  if (largest < 1 || largest > 65535) throw std::runtime_error("expected a maximum of 1 to 65535");
  const std::size_t width = largest > 255 ? 2 : 1;
  const std::size_t count = 3 * image.pixel_count();
  const std::string_view pixels = reader.pixels(count * width);
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(pixels[i]); };
  image.rgb.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const int value = width == 1 ? byte(i) : 256 * byte(2 * i) + byte(2 * i + 1);
    const float scaled = std::min(1.0F, static_cast<float>(value) / static_cast<float>(largest));
    image.rgb[i] = srgb ? linear_from_srgb(scaled) : scaled;
  }
  return image;
}

// Rows go from bottom to top; a negative scale means little-endian.
std::string encode_pfm(const Image& image) {
  const bool little = std::endian::native == std::endian::little;
  std::string bytes = header("PF", image.width, image.height, little ? "-1.0" : "1.0");
  const std::size_t row = 3 * static_cast<std::size_t>(image.width);
  for (auto y = static_cast<std::size_t>(image.height); y-- > 0;) {
    bytes.append(reinterpret_cast<const char*>(image.rgb.data() + y * row), row * sizeof(float));
  }
  return bytes;
}

Image decode_pfm(std::string_view bytes) {
  HeaderReader reader(bytes);
  const std::size_t channels = reader.word() == "PF" ? 3 : 1;
  Image image;
  image.width = reader.number<int>();
  image.height = reader.number<int>();
  const auto scale = reader.number<double>();
  check_image_size(image.width, image.height, bytes.size());
  if (!std::isfinite(scale) || scale == 0) throw std::runtime_error("expected a scale, not 0");
  const std::size_t pixel_count = image.pixel_count();
  const std::string_view pixels = reader.pixels(pixel_count * channels * sizeof(float));
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  image.rgb.resize(3 * pixel_count);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t source =
            ((height - 1 - y) * width + x) * channels + (channels == 3 ? c : 0);
        image.rgb[3 * (y * width + x) + c] = float_at(pixels, source, scale > 0);
      }
    }
  }
  return image;
}

}  // namespace lightbench
