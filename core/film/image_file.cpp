#include "core/film/image_file.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "core/error.h"
#include "core/film/image_formats.h"
#include "core/film/tone_map.h"
#include "core/scene/file.h"

namespace lightbench {
namespace {

constexpr std::int64_t kLargestSide = 65536;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 27;
// The strongest compression among the formats (deflate, 1032:1, of one-bit pixels) with room.
constexpr std::int64_t kMostPixelsPerByte = 16384;

constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";

std::string extension(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_output(const std::string& type) {
  return type == ".png" || type == ".exr" || type == ".hdr" || type == ".pfm" || type == ".ppm";
}

std::string encode(const std::string& type, const Image& image, const Display& display,
                   const ImageMetadata& metadata, const std::vector<float>& variance,
                   ExrNumbers numbers) {
  if (type == ".exr") return encode_exr(image, metadata, variance, numbers);
  if (type == ".hdr") return encode_hdr(image);
  if (type == ".pfm") return encode_pfm(image);
  const ByteImage bytes{image.width, image.height, to_8_bit(image, display)};
  return type == ".png" ? encode_png(bytes, metadata) : encode_ppm(bytes);
}

// By content, not by name: files are often misnamed.
Image decode(std::string_view bytes, bool srgb) {
  if (bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8"))
    return decode_8_bit(bytes, srgb);
  if (bytes.starts_with(kExrMagic)) return decode_exr(bytes);
  if (bytes.starts_with("#?RADIANCE") || bytes.starts_with("#?RGBE")) return decode_hdr(bytes);
  if (bytes.starts_with("PF") || bytes.starts_with("Pf")) return decode_pfm(bytes);
  if (bytes.starts_with("P6")) return decode_ppm(bytes, srgb);
  throw std::runtime_error("expected a PNG, JPEG, EXR, HDR, PFM or PPM image");
}

}  // namespace

void check_image_size(std::int64_t width, std::int64_t height, std::size_t file_bytes) {
  if (width < 1 || height < 1) throw std::runtime_error("the image is empty");
  const auto size = std::to_string(width) + " x " + std::to_string(height);
  if (width > kLargestSide || height > kLargestSide || width * height > kMostPixels)
    throw std::runtime_error("expected at most 134217728 pixels, got " + size);
  if (width * height / kMostPixelsPerByte > static_cast<std::int64_t>(file_bytes))
    throw std::runtime_error("the file is too short for " + size + " pixels");
}

void check_image_name(const std::filesystem::path& file) {
  if (!is_output(extension(file))) {
    throw Error(ErrorKind::Usage,
                file.string() + ": expected a name that ends in .png, .exr, .hdr, .pfm or .ppm");
  }
}

void write_image(const std::filesystem::path& file, const Image& image, const Display& display,
                 const ImageMetadata& metadata, const std::vector<float>& variance,
                 ExrNumbers numbers) {
  check_image_name(file);
  const std::size_t pixels = image.pixel_count();
  if (image.width < 1 || image.height < 1 || image.rgb.size() != 3 * pixels ||
      (!variance.empty() && variance.size() != pixels))
    throw Error(ErrorKind::Internal, file.string() + ": the image and its size do not agree");
  const auto fail = [&file](const std::string& why) {
    throw Error(ErrorKind::Output, file.string() + ": cannot be written: " + why);
  };
  std::string bytes;
  try {
    bytes = encode(extension(file), image, display, metadata, variance, numbers);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  if (const auto folder = file.parent_path(); !folder.empty()) {
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) fail(code.message());
  }
  replace_file(file, bytes);
}

namespace {

/// f of the bytes of a file; what it throws becomes an error that names the file.
template <class F>
auto with_bytes(const std::filesystem::path& file, F f) {
  const std::string bytes = read_file(file);
  try {
    return f(std::string_view(bytes));
  } catch (const std::exception& error) {
    throw Error(ErrorKind::Scene, file.string() + ": cannot be read: " + error.what());
  }
}

}  // namespace

Image read_image(const std::filesystem::path& file, bool srgb) {
  return with_bytes(file, [srgb](std::string_view bytes) { return decode(bytes, srgb); });
}

ImageMetadata read_image_metadata(const std::filesystem::path& file) {
  return with_bytes(file, [](std::string_view bytes) {
    return bytes.starts_with(kExrMagic) ? decode_exr_metadata(bytes) : ImageMetadata();
  });
}

}  // namespace lightbench
