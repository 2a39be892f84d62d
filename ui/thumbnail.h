#pragma once
// A small picture for lists.

#include <cstdint>
#include <vector>

#include "core/scene/image.h"
#include "core/scene/scene.h"

namespace lightbench::ui {

/// 8-bit RGB, top row first.
struct SmallImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// `image` as `display` shows it, averaged down until neither side exceeds `longest`. Any thread.
SmallImage make_small(const Image& image, const Display& display, int longest);

/// A texture of it; needs a current OpenGL context for its whole life.
class Thumbnail {
 public:
  Thumbnail() = default;
  explicit Thumbnail(const SmallImage& image);
  ~Thumbnail();
  Thumbnail(Thumbnail&& other) noexcept;
  Thumbnail& operator=(Thumbnail&& other) noexcept;
  [[nodiscard]] unsigned texture() const { return texture_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  unsigned texture_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace lightbench::ui
