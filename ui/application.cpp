#include "ui/application.h"

#include <imgui.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/scene/scene_io.h"
#include "ui/layout.h"
#include "ui/panels.h"
#include "ui/refresh.h"

namespace lightbench::ui {
namespace {

constexpr double kTooltipDelay = 0.6;
constexpr double kWheelPause = 0.4;  // turns of the wheel closer than this are one undo step

double seconds_between(std::chrono::steady_clock::time_point from,
                       std::chrono::steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

void call_wake(void* context) { (*static_cast<std::function<void()>*>(context))(); }

}  // namespace

Application::Application(GlContext& gl, Scene scene, const std::filesystem::path& file,
                         const ApplicationOptions& options, std::function<void()> wake)
    : gl_(gl),
      options_(options),
      wake_(std::move(wake)),
      gui_(gl, options.scale > 0 ? options.scale : gl.content_scale(), options.layout_file),
      bench_(std::move(scene), file, wake_),
      last_frame_(Clock::now()) {
  bench_.threads = options.threads;
  bench_.snapshots.automatic = options.write_snapshots;
  start_session();
  submit();
}

Application::~Application() = default;

void Application::start_session() {
  session_.reset();
  SessionOptions options;
  options.threads = bench_.threads;
  options.interactive = true;
  options.low_priority = true;
  options.kernel = options_.kernel;
  session_ = std::make_unique<Session>(options);
  session_->set_wake(call_wake, &wake_);
  session_threads_ = bench_.threads;
}

void Application::submit() {
  submitted_ = bench_.editor.scene;
  if (rejected_) bench_.notice = {};  // it said why the scene before this one was refused
  rejected_.reset();
  generation_ = session_->submit(bench_.editor.scene);
}

void Application::keep_snapshots() {
  bench_.jobs.finish();
  for (const std::shared_ptr<const Frame>& frame : session_->take_snapshots()) {
    const std::vector<int>& counts = bench_.editor.scene.render.snapshots;
    const bool listed =
        std::find(counts.begin(), counts.end(), static_cast<int>(frame->spp)) != counts.end();
    const bool asked = snapshots_asked_ > 0;
    if (asked) --snapshots_asked_;
    if (asked || bench_.snapshots.automatic) {
      // Edits would pile up files at each count; a picture that somebody asked for stays.
      bench_.snapshots.keep(frame, bench_.editor.scene, bench_.editor.title(), listed && !asked,
                            bench_.jobs);
    }
  }
}

void Application::take_results() {
  keep_snapshots();
  bench_.status = session_->status();
  if (const auto latest = session_->latest(); latest && latest->serial != shown_serial_) {
    bench_.frame = latest;
    bench_.picture.upload(latest->image);
    shown_serial_ = latest->serial;
    shown_generation_ = latest->generation;
    shown_divider_ = latest->divider;
    if (edit_time_ && latest->generation >= generation_) {
      bench_.edit_times.add(seconds_between(*edit_time_, Clock::now()));
      edit_time_.reset();
    }
  }
  bench_.picture.develop(bench_.editor.scene.display);
  shown_state_ = bench_.status.state;
}

void Application::draw_panels() {
  draw_menu_bar(bench_);
  draw_status_bar(bench_);
  if (bench_.panels_shown) {
    draw_dock_space(std::exchange(reset_layout_, false), static_cast<float>(gui_.scale()));
    draw_scene_panel(bench_);
    draw_lights_panel(bench_);
    draw_materials_panel(bench_);
    draw_snapshots_panel(bench_);
    draw_statistics_panel(bench_);
    draw_properties_panel(bench_);
    draw_camera_panel(bench_);
    draw_environment_panel(bench_);
    draw_render_panel(bench_);
  }
  draw_picture_panel(bench_);
  draw_help(bench_);
  bench_.file_dialog.draw();
  draw_unsaved_question(bench_);
}

void Application::follow_edits() {
  Editor& editor = bench_.editor;
  wheel_pending_ = bench_.wheel_time >= 0 && ImGui::GetTime() - bench_.wheel_time < kWheelPause;
  const bool busy = ImGui::IsAnyItemActive() || bench_.navigating || wheel_pending_;
  if (!busy) {
    const std::string refused = editor.commit();
    if (!refused.empty()) bench_.notice = {refused, true};
    if (bench_.threads != session_threads_) {
      start_session();
      submit();
    }
  }
  if (editor.scene == submitted_ || (rejected_ && editor.scene == *rejected_)) return;
  try {
    validate(editor.scene);
  } catch (const Error& error) {
    // The last valid scene renders on; a scene still invalid when the edit ends is taken back.
    bench_.notice = {error.what(), true};
    rejected_ = editor.scene;
    return;
  }
  const std::uint64_t before = generation_;
  submit();
  if (generation_ != before && !edit_time_) edit_time_ = Clock::now();
}

void Application::frame(double seconds) {
  const Clock::time_point start = Clock::now();
  // Another size settles like input does: some widgets know their place only one frame later.
  const bool resized = gl_.width() != drawn_width_ || gl_.height() != drawn_height_;
  drawn_width_ = gl_.width();
  drawn_height_ = gl_.height();
  const bool had_input = gui_.input_waits();
  take_results();
  if (gl_.window() != nullptr && options_.scale <= 0 && gl_.content_scale() != gui_.scale()) {
    gui_.set_scale(gl_.content_scale());
  }
  gui_.begin_frame(seconds);
  if (const auto action = pressed_action();
      action && !bench_.file_dialog.is_open() && !bench_.unsaved_asked) {
    bench_.request(*action);
  }
  draw_panels();
  for (const Action action : std::exchange(bench_.requests, {})) perform(action);
  follow_edits();
  gui_.end_frame();
  settling_frames_ = had_input || resized ? 2 : std::max(0, settling_frames_ - 1);
  hover_pending_ =
      had_input || (hover_pending_ && seconds_between(last_frame_, start) < kTooltipDelay);
  last_frame_ = Clock::now();
  bench_.frame_times.add(seconds_between(start, last_frame_));
}

double Application::seconds_to_next_frame() {
  const double age = seconds_between(last_frame_, Clock::now());
  if (settling_frames_ > 0 || gui_.input_waits() || !bench_.requests.empty()) return 0;
  // A held key or mouse button keeps moving the camera without further events.
  if (bench_.navigating) return std::max(0.0, 1.0 / 60 - age);
  double wait = std::numeric_limits<double>::infinity();
  if (hover_pending_) wait = kTooltipDelay - age;
  if (wheel_pending_) wait = std::min(wait, kWheelPause - age);
  const SessionStatus status = session_->status();
  if (status.state != shown_state_) return 0;
  const auto latest = session_->latest();
  const bool newer = latest && latest->serial != shown_serial_;
  if (newer && (latest->generation != shown_generation_ || latest->divider < shown_divider_)) {
    return 0;
  }
  if (newer || status.state == SessionState::Rendering || status.state == SessionState::Compiling) {
    const double interval =
        refresh_interval(status.spp, status.seconds, bench_.frame_times.quantile(0.5));
    // With no new picture only the clock and the progress bar would move.
    wait = std::min(wait, (newer ? interval : std::max(1.0, interval)) - age);
  }
  if (bench_.jobs.pending() > 0) wait = std::min(wait, 0.25 - age);
  return std::max(0.0, wait);
}

}  // namespace lightbench::ui
