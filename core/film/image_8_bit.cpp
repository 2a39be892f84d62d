// PNG and JPEG input through stb.

#include <stb_image.h>

#include <limits>
#include <memory>
#include <stdexcept>

#include "core/film/image_formats.h"
#include "core/film/tone_map.h"

namespace lightbench {
namespace {

struct StbFree {
  void operator()(void* data) const { stbi_image_free(data); }
};
template <class T>
using StbPixels = std::unique_ptr<T, StbFree>;

struct StbInput {
  const stbi_uc* data;
  int size;
};

[[noreturn]] void fail() {
  const char* reason = stbi_failure_reason();
  throw std::runtime_error(reason != nullptr ? reason : "the file is damaged");
}

/// Checks the size that the header claims before anything is decoded.
StbInput open(std::string_view bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::runtime_error("expected a file below 2 GiB");
  const StbInput input{reinterpret_cast<const stbi_uc*>(bytes.data()),
                       static_cast<int>(bytes.size())};
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(input.data, input.size, &width, &height, &channels) == 0) fail();
  check_image_size(width, height, bytes.size());
  return input;
}

/// Values 0..largest to [0, 1], through the sRGB curve if asked, by table.
template <class T>
void decode_values(const T* values, Image& image, bool srgb) {
  constexpr std::size_t kCount = std::size_t{std::numeric_limits<T>::max()} + 1;
  std::vector<float> table(kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    const float value = static_cast<float>(i) / static_cast<float>(kCount - 1);
    table[i] = srgb ? linear_from_srgb(value) : value;
  }
  image.rgb.resize(3 * image.pixel_count());
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = table[values[i]];
}

}  // namespace

Image decode_8_bit(std::string_view bytes, bool srgb) {
  const StbInput input = open(bytes);
  Image image;
  int channels = 0;
  if (stbi_is_16_bit_from_memory(input.data, input.size) != 0) {
    const StbPixels<stbi_us> pixels(stbi_load_16_from_memory(input.data, input.size, &image.width,
                                                             &image.height, &channels, 3));
    if (!pixels) fail();
    decode_values(pixels.get(), image, srgb);
  } else {
    const StbPixels<stbi_uc> pixels(
        stbi_load_from_memory(input.data, input.size, &image.width, &image.height, &channels, 3));
    if (!pixels) fail();
    decode_values(pixels.get(), image, srgb);
  }
  return image;
}

}  // namespace lightbench
