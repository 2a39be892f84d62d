// Radiance HDR (RGBE): output through stb, input by hand because stb 2.27 never returns from some
// damaged files (a run of length 0 at the end). G. Ward, "Real Pixels", Graphics Gems II.

#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "core/film/image_formats.h"

namespace lightbench {
namespace {

using Rgbe = std::array<unsigned char, 4>;

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  unsigned char byte() {
    if (rest_.empty()) throw std::runtime_error("the file ends too early");
    const char c = rest_[0];
    rest_.remove_prefix(1);
    return static_cast<unsigned char>(c);
  }
  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) throw std::runtime_error("the header does not end");
    const std::string_view result = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return result;
  }
  Rgbe pixel() {
    Rgbe value{};
    for (unsigned char& part : value) part = byte();
    return value;
  }
  /// Looks ahead at a pixel without taking it; zeros if the file ends.
  [[nodiscard]] Rgbe peek() const {
    Rgbe value{};
    for (std::size_t i = 0; i < 4 && i < rest_.size(); ++i)
      value[i] = static_cast<unsigned char>(rest_[i]);
    return value;
  }

 private:
  std::string_view rest_;
};

int number(std::string_view text) {
  int value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size())
    throw std::runtime_error("expected \"-Y height +X width\"");
  return value;
}

/// "-Y 480 +X 640": the orientation that everyone writes.
void read_size(std::string_view line, Image& image) {
  const std::size_t x = line.find(" +X ");
  if (!line.starts_with("-Y ") || x == std::string_view::npos || x < 3)
    throw std::runtime_error("expected \"-Y height +X width\"");
  image.height = number(line.substr(3, x - 3));
  image.width = number(line.substr(x + 4));
}

// Each of the four parts of a row in turn, in runs (count above 128) and literals.
void read_packed_row(ByteReader& reader, std::vector<Rgbe>& row) {
  reader.pixel();  // the mark that says so
  for (std::size_t part = 0; part < 4; ++part) {
    for (std::size_t x = 0; x < row.size();) {
      const unsigned count = reader.byte();
      const bool run = count > 128;
      const std::size_t length = run ? count - 128 : count;
      if (length == 0 || length > row.size() - x) throw std::runtime_error("a run is damaged");
      const unsigned char repeated = run ? reader.byte() : static_cast<unsigned char>(0);
      for (std::size_t i = 0; i < length; ++i) row[x++][part] = run ? repeated : reader.byte();
    }
  }
}

void append(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                             static_cast<std::size_t>(size));
}

}  // namespace

Image decode_hdr(std::string_view bytes) {
  ByteReader reader(bytes);
  bool format = false;
  for (std::string_view line = reader.line(); !line.empty(); line = reader.line())
    format = format || line == "FORMAT=32-bit_rle_rgbe";
  if (!format) throw std::runtime_error("expected FORMAT=32-bit_rle_rgbe");
  Image image;
  read_size(reader.line(), image);
  check_image_size(image.width, image.height, bytes.size());
  image.rgb.reserve(3 * image.pixel_count());
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; ++y) {
    const Rgbe mark = reader.peek();
    const bool packed = image.width >= 8 && image.width < 32768 && mark[0] == 2 && mark[1] == 2 &&
                        mark[2] * 256 + mark[3] == image.width;
    if (packed) {
      read_packed_row(reader, row);
    } else {
      for (Rgbe& pixel : row) pixel = reader.pixel();
    }
    for (const Rgbe& pixel : row) {
      const float step = pixel[3] == 0 ? 0.0F : std::ldexp(1.0F, pixel[3] - 136);
      for (std::size_t c = 0; c < 3; ++c) image.rgb.push_back(static_cast<float>(pixel[c]) * step);
    }
  }
  return image;
}

std::string encode_hdr(const Image& image) {
  // The shared exponent holds nothing negative and nothing above 2^127.
  std::vector<float> rgb(image.rgb);
  for (float& value : rgb) value = value > 0 ? std::min(value, 1e38F) : 0.0F;
  std::string bytes;
  if (stbi_write_hdr_to_func(append, &bytes, image.width, image.height, 3, rgb.data()) == 0)
    throw std::runtime_error("the HDR encoder failed");
  return bytes;
}

}  // namespace lightbench
