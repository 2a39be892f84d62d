#pragma once
// The one place where an OpenGL 3.3 core context is made: in a window, or in memory without a
// display.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

struct GLFWwindow;
struct osmesa_context;

namespace lightbench::ui {

enum class GlBackend { Window, OSMesa };

/// Owns the context, current on the thread that made it, and its window or memory. One at a time.
class GlContext {
 public:
  /// `width` x `height` in screen coordinates (Window) or pixels (OSMesa). Throws Error{Usage} if
  /// there is no display or no OpenGL 3.3.
  GlContext(GlBackend backend, int width, int height, const std::string& title);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Null off-screen.
  [[nodiscard]] GLFWwindow* window() const { return window_; }
  /// Size of what is drawn to, in pixels; 0 x 0 while minimised.
  [[nodiscard]] int width() const;
  [[nodiscard]] int height() const;
  /// Pixels per layout unit that the desktop asks for; 1 off-screen.
  [[nodiscard]] double content_scale() const;
  /// Shows what was drawn. With a window, waits for the display at most once per refresh.
  void present();
  /// Windows only; back to the place it had before.
  void toggle_full_screen();
  /// The picture drawn last, 8-bit RGB, top row first.
  [[nodiscard]] std::vector<std::uint8_t> read_rgb() const;

 private:
  void open_window(int width, int height, const std::string& title);
  void open_memory(int width, int height);

  GLFWwindow* window_ = nullptr;
  osmesa_context* memory_context_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::array<int, 4> windowed_{};     ///< position and size before full screen
  std::vector<std::uint8_t> memory_;  ///< what OSMesa draws to, RGBA
};

}  // namespace lightbench::ui
