#include "ui/thumbnail.h"

#include <glad/gl.h>

#include <algorithm>
#include <utility>

#include "core/film/tone_map.h"

namespace lightbench::ui {

SmallImage make_small(const Image& image, const Display& display, int longest) {
  const int block = std::max(1, (std::max(image.width, image.height) + longest - 1) / longest);
  Image small;
  small.width = std::max(1, image.width / block);
  small.height = std::max(1, image.height / block);
  small.rgb.assign(small.pixel_count() * 3, 0.0F);
  const auto weight = 1.0F / static_cast<float>(block * block);
  for (int y = 0; y < small.height * block && y < image.height; ++y) {
    for (int x = 0; x < small.width * block && x < image.width; ++x) {
      const auto from = static_cast<std::size_t>(y * image.width + x) * 3;
      const auto to = static_cast<std::size_t>(y / block * small.width + x / block) * 3;
      for (std::size_t c = 0; c < 3; ++c) small.rgb[to + c] += weight * image.rgb[from + c];
    }
  }
  return {small.width, small.height, to_8_bit(small, display)};
}

Thumbnail::Thumbnail(const SmallImage& image) : width_(image.width), height_(image.height) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE,
               image.rgb.data());
}

Thumbnail::~Thumbnail() {
  if (texture_ != 0) glDeleteTextures(1, &texture_);
}

Thumbnail::Thumbnail(Thumbnail&& other) noexcept
    : texture_(std::exchange(other.texture_, 0U)), width_(other.width_), height_(other.height_) {}

Thumbnail& Thumbnail::operator=(Thumbnail&& other) noexcept {
  std::swap(texture_, other.texture_);
  std::swap(width_, other.width_);
  std::swap(height_, other.height_);
  return *this;
}

}  // namespace lightbench::ui
