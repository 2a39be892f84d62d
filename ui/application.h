#pragma once
// The viewer: a workbench, a render session and the screen, tied together one UI frame at a time.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "core/session/session.h"
#include "ui/gl_context.h"
#include "ui/gui.h"
#include "ui/workbench.h"

namespace lightbench::ui {

struct ApplicationOptions {
  int threads = -1;  ///< as SessionOptions::threads
  KernelKind kernel = KernelKind::Auto;
  double scale = 0;                   ///< pixels per layout unit; 0 = what the desktop asks for
  std::filesystem::path layout_file;  ///< empty = the layout is not kept
  bool write_snapshots = true;        ///< at the counts the scene lists
};

/// UI thread only.
class Application {
 public:
  /// `wake` is called from other threads when a frame is due sooner than the caller waits.
  Application(GlContext& gl, Scene scene, const std::filesystem::path& file,
              const ApplicationOptions& options, std::function<void()> wake);
  ~Application();
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;

  /// One round: results in, panels drawn, edits submitted. `seconds` as for Gui::begin_frame.
  void frame(double seconds = 0);
  /// What goes on while there is nothing to draw to: snapshots that are due are written.
  void keep_snapshots();

  /// Seconds until the next frame should be drawn if no input comes: 0 = now, infinite = nothing
  /// changes by itself.
  [[nodiscard]] double seconds_to_next_frame();
  /// True once, when the user wants to quit and nothing is left unsaved.
  [[nodiscard]] bool closing() const { return closing_; }
  /// Asks to quit, as the window's close button does.
  void ask_to_quit() { bench_.request(Action::Quit); }

  [[nodiscard]] Workbench& bench() { return bench_; }
  [[nodiscard]] Gui& gui() { return gui_; }
  /// Generation of the scene as it is now; pictures of older ones are on their way out.
  [[nodiscard]] std::uint64_t generation() const { return generation_; }

 private:
  using Clock = std::chrono::steady_clock;

  void start_session();
  void take_results();
  void draw_panels();
  void follow_edits();
  void submit();
  void perform(Action action);
  void perform_on_file(Action action);
  void perform_on_view(Action action);
  void save(const std::filesystem::path& file);
  void ask_where_to_save();
  void open(const std::filesystem::path& file);
  void show(Scene scene, const std::filesystem::path& file);
  /// False if there are unsaved changes; then the user is asked and `action` waits.
  bool may_discard(Action action);

  GlContext& gl_;
  ApplicationOptions options_;
  std::function<void()> wake_;
  Gui gui_;
  Workbench bench_;
  std::unique_ptr<Session> session_;
  int session_threads_ = 0;

  Scene submitted_;
  std::optional<Scene> rejected_;  ///< edited into this, which validate() refuses
  std::uint64_t generation_ = 0;
  std::optional<Clock::time_point> edit_time_;  ///< of the edit whose picture is not shown yet
  int snapshots_asked_ = 0;

  Action waiting_ = Action::None;  ///< for the answer about unsaved changes
  bool discard_ = false;
  bool closing_ = false;
  bool reset_layout_ = false;

  std::uint64_t shown_serial_ = 0;
  std::uint64_t shown_generation_ = 0;
  int shown_divider_ = 1;
  SessionState shown_state_ = SessionState::Idle;
  Clock::time_point last_frame_;
  int drawn_width_ = 0, drawn_height_ = 0;
  int settling_frames_ = 3;     ///< frames ImGui still needs after input
  bool wheel_pending_ = false;  ///< the last turn of the wheel is not an undo step yet
  bool hover_pending_ = false;  ///< a tooltip may be due a moment after the last input
};

}  // namespace lightbench::ui
