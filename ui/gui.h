#pragma once
// Dear ImGui on a GlContext: fonts, theme, input, and one frame at a time.

#include <filesystem>
#include <string>

#include "ui/gl_context.h"
#include "ui/widget_map.h"

struct ImGuiContext;

namespace lightbench::ui {

/// Owns the ImGui context (current for its whole life). UI thread only.
class Gui {
 public:
  /// `scale` is pixels per layout unit. Window layout is kept in `layout_file`; empty = not kept.
  Gui(GlContext& gl, double scale, const std::filesystem::path& layout_file);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  /// Between the two, widgets are drawn. `seconds` since the last frame; unused with a window.
  void begin_frame(double seconds);
  void end_frame();

  /// True if input waits that no frame has seen yet.
  [[nodiscard]] bool input_waits() const;
  [[nodiscard]] double scale() const { return scale_; }
  void set_scale(double scale);
  /// Widgets of the last frame.
  [[nodiscard]] const WidgetMap& widgets() const { return widgets_; }

 private:
  void note_tabs();

  GlContext& gl_;
  ImGuiContext* context_ = nullptr;
  std::string layout_file_;
  WidgetMap widgets_;
  double scale_ = 1;
};

/// Where the layout is kept between runs: $XDG_STATE_HOME/lightbench, or ~/.local/state/lightbench.
/// Empty if there is no home.
std::filesystem::path default_layout_file();

}  // namespace lightbench::ui
