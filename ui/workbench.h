#pragma once
// What the panels share. A panel reads anything here, edits `editor` and the view, and asks for
// everything else by an Action; the application carries those out after the panels are drawn.

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/film/frame.h"
#include "core/session/session.h"
#include "ui/background_jobs.h"
#include "ui/editor.h"
#include "ui/file_dialog.h"
#include "ui/picture.h"
#include "ui/picture_view.h"
#include "ui/shortcuts.h"
#include "ui/snapshots.h"
#include "ui/timings.h"

namespace lightbench::ui {

/// A line for the user, until it is closed or replaced.
struct Notice {
  std::string text;
  bool error = false;
};

/// UI thread only.
struct Workbench {
  Editor editor;
  Picture picture;
  PictureView view;
  std::optional<glm::dvec3> pivot;  ///< orbit centre; the camera's target if not set
  double fly_speed = 1;             ///< factor on the speed that suits the scene
  double shown_zoom = 1;            ///< screen pixels per picture pixel in this UI frame
  bool navigating = false;          ///< a camera gesture is under way: not yet an undo step
  double wheel_time = -1;           ///< ImGui time of the last turn of the wheel

  std::shared_ptr<const Frame> frame;  ///< newest picture, null before the first
  SessionStatus status;                ///< of this UI frame
  int threads = 0;                     ///< render threads asked for; as SessionOptions::threads

  SnapshotLog snapshots;
  FileDialog file_dialog;
  Notice notice;
  std::vector<Action> requests;

  bool panels_shown = true;
  bool help_shown = false;
  bool outline_shown = true;   ///< box around the selected object
  bool unsaved_asked = false;  ///< the question about unsaved changes is up

  Timings frame_times;  ///< seconds spent drawing each UI frame
  Timings edit_times;   ///< seconds from an edit to the first picture of it

  BackgroundJobs jobs;  ///< last: its jobs refer to the members above

  Workbench(Scene scene, std::filesystem::path file, std::function<void()> wake);

  void request(Action action) { requests.push_back(action); }
};

/// A convenient step for dragging lengths of this scene, per mouse pixel.
double length_step(const Scene& scene);

/// Loads an image off the UI thread into `assign`, which runs on the UI thread. `file` as in the
/// scene: relative to its folder.
void load_image_later(Workbench& bench, const std::string& file, bool srgb,
                      std::function<void(Scene&, std::shared_ptr<const Texels>)> assign);

/// `file` as a scene stores it: relative to the scene's folder where possible.
std::string asset_name(const Editor& editor, const std::filesystem::path& file);

}  // namespace lightbench::ui
