// PNG output through libpng: sRGB chunk and text, which stb cannot write.

#include <png.h>

#include <algorithm>
#include <stdexcept>

#include "core/film/image_formats.h"

namespace lightbench {
namespace {

constexpr std::size_t kLongestKeyword = 79;

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}
void flush(png_structp) {}
void quiet(png_structp, png_const_charp) {}

/// PNG names its standard keywords with a capital.
std::string keyword(const std::string& key) {
  std::string word = key.substr(0, kLongestKeyword);
  for (const char* standard : {"software", "title", "author", "source", "comment"})
    if (word == standard) word[0] = static_cast<char>(word[0] - 'a' + 'A');
  return word;
}

std::vector<png_text> texts_of(std::vector<std::pair<std::string, std::string>>& entries) {
  std::vector<png_text> texts;
  for (auto& [key, value] : entries) {
    png_text text{};
    text.compression = PNG_ITXT_COMPRESSION_NONE;  // the text chunk that is UTF-8
    text.key = key.data();
    text.text = value.data();
    text.itxt_length = value.size();
    texts.push_back(text);
  }
  return texts;
}

// libpng reports errors by longjmp, so nothing with a destructor may live in this function.
bool write(png_structp png, png_infop info, std::string* out, const ByteImage* image,
           std::vector<png_text>* texts) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, out, append, flush);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image->width),
               static_cast<png_uint_32>(image->height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!texts->empty()) png_set_text(png, info, texts->data(), static_cast<int>(texts->size()));
  png_write_info(png, info);
  const std::size_t stride = 3 * static_cast<std::size_t>(image->width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(image->height); ++y)
    png_write_row(png, image->rgb.data() + y * stride);
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

std::string encode_png(const ByteImage& image, const ImageMetadata& metadata) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const auto& [key, value] : metadata)
    if (!key.empty()) entries.emplace_back(keyword(key), value);
  std::vector<png_text> texts = texts_of(entries);

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, quiet);
  if (png == nullptr) throw std::bad_alloc();
  png_infop info = png_create_info_struct(png);
  std::string out;
  const bool ok = info != nullptr && write(png, info, &out, &image, &texts);
  png_destroy_write_struct(&png, &info);
  if (!ok) throw std::runtime_error("the PNG encoder failed");
  return out;
}

}  // namespace lightbench
