#pragma once
// The rendered picture on the GPU: linear floats in, display values out. Exposure and tone mapping
// happen here, so that changing them never touches the render.

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/image.h"
#include "core/scene/scene.h"

namespace lightbench::ui {

/// Needs a current OpenGL 3.3 context for its whole life.
class Picture {
 public:
  Picture();
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  /// Takes over new linear pixels.
  void upload(const Image& image);
  /// Makes texture() show them as `display` says; same values as display_value() within 1/255.
  /// Does nothing if neither the pixels nor the display changed.
  void develop(const Display& display);

  /// 8-bit texture, top row first, with mipmaps; 0 before the first upload.
  [[nodiscard]] unsigned texture() const { return developed_ ? display_texture_ : 0; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Display values as drawn, 8-bit RGB, top row first.
  [[nodiscard]] std::vector<std::uint8_t> read_rgb() const;

 private:
  unsigned program_ = 0, vertex_array_ = 0, framebuffer_ = 0;
  unsigned linear_texture_ = 0, display_texture_ = 0;
  int exposure_location_ = -1, tone_map_location_ = -1;
  int width_ = 0, height_ = 0;
  bool developed_ = false;
  bool stale_ = true;
  Display shown_;
};

}  // namespace lightbench::ui
