#pragma once
// One encoder and one decoder per image format, bytes to pixels; image_file.cpp chooses by name.
// Every function throws std::exception with a reason that does not name the file.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/film/image_file.h"

namespace lightbench {

/// Display-referred pixels: 8-bit sRGB, top row first.
struct ByteImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

std::string encode_png(const ByteImage& image, const ImageMetadata& metadata);
std::string encode_ppm(const ByteImage& image);
/// RGB and, if `variance` is given, a float channel `variance.Y`.
std::string encode_exr(const Image& image, const ImageMetadata& metadata,
                       const std::vector<float>& variance, ExrNumbers numbers);
std::string encode_hdr(const Image& image);
std::string encode_pfm(const Image& image);

/// PNG and JPEG; `srgb` decodes the transfer curve, else values are divided by the largest.
Image decode_8_bit(std::string_view bytes, bool srgb);
Image decode_ppm(std::string_view bytes, bool srgb);
Image decode_hdr(std::string_view bytes);
Image decode_exr(std::string_view bytes);
ImageMetadata decode_exr_metadata(std::string_view bytes);
Image decode_pfm(std::string_view bytes);

/// Refuses sizes that a file of so many bytes cannot honestly hold, before memory is asked for.
void check_image_size(std::int64_t width, std::int64_t height, std::size_t file_bytes);

}  // namespace lightbench
