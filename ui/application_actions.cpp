// What menus, keys and buttons ask for.

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

#include "core/scene/bounds.h"
#include "core/scene/scene_io.h"
#include "ui/application.h"
#include "ui/navigation.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

double aspect_of(const Scene& scene) {
  return static_cast<double>(scene.render.width) / static_cast<double>(scene.render.height);
}

Bounds selection_bounds(const Scene& scene, Selection selection) {
  if (selection.kind != ItemKind::Object || !is_valid(scene, selection)) return {};
  return object_bounds(scene.objects[static_cast<std::size_t>(selection.index)], scene.camera,
                       all_mesh_bounds(scene));
}

}  // namespace

void Application::perform(Action action) {
  Editor& editor = bench_.editor;
  switch (action) {
    case Action::NewScene:
    case Action::Open:
    case Action::Save:
    case Action::SaveAs:
    case Action::Quit:
    case Action::SaveAndContinue:
    case Action::DiscardAndContinue:
      perform_on_file(action);
      break;
    case Action::Undo:
      editor.undo();
      break;
    case Action::Redo:
      editor.redo();
      break;
    case Action::Duplicate:
      editor.selection = duplicate(editor.scene, editor.selection);
      break;
    case Action::Delete:
      editor.selection = remove(editor.scene, editor.selection);
      break;
    case Action::PauseResume:
      session_->pause(bench_.status.state != SessionState::Paused);
      break;
    case Action::Restart:
      session_->pause(false);
      session_->restart();
      break;
    case Action::SnapshotNow:
      if (bench_.frame) {
        ++snapshots_asked_;
        session_->request_snapshot();
      }
      break;
    default:
      perform_on_view(action);
      break;
  }
}

void Application::perform_on_view(Action action) {
  Scene& scene = bench_.editor.scene;
  const auto expose = [&](double stops) {
    scene.display.exposure = glm::clamp(scene.display.exposure + stops, -20.0, 20.0);
  };
  switch (action) {
    case Action::FrameSelection:
      scene.camera = frame_bounds(scene.camera, selection_bounds(scene, bench_.editor.selection),
                                  aspect_of(scene));
      bench_.pivot.reset();
      break;
    case Action::FrameAll:
      scene.camera = frame_bounds(scene.camera, scene_bounds(scene), aspect_of(scene));
      bench_.pivot.reset();
      break;
    case Action::ExposureUp:
      expose(0.5);
      break;
    case Action::ExposureDown:
      expose(-0.5);
      break;
    case Action::ExposureUpFine:
      expose(1.0 / 6);
      break;
    case Action::ExposureDownFine:
      expose(-1.0 / 6);
      break;
    case Action::ExposureReset:
      scene.display.exposure = 0;
      break;
    case Action::ZoomFit:
      bench_.view = {};
      break;
    case Action::ZoomActual:
      bench_.view = {.zoom = 1, .center = glm::dvec2(0.5)};
      break;
    case Action::ToggleHelp:
      bench_.help_shown = !bench_.help_shown;
      break;
    case Action::TogglePanels:
      bench_.panels_shown = !bench_.panels_shown;
      break;
    case Action::ToggleFullScreen:
      gl_.toggle_full_screen();
      break;
    case Action::ResetLayout:
      reset_layout_ = true;
      break;
    default:
      break;
  }
}

void Application::perform_on_file(Action action) {
  switch (action) {
    case Action::NewScene:
      if (may_discard(action)) show(new_scene(), {});
      break;
    case Action::Open:
      if (may_discard(action)) {
        bench_.file_dialog.ask({"Open scene",
                                false,
                                bench_.editor.directory(),
                                {".json"},
                                [this](const std::filesystem::path& file) { open(file); }});
      }
      break;
    case Action::Save:
      if (bench_.editor.file().empty()) {
        ask_where_to_save();
      } else {
        save(bench_.editor.file());
      }
      break;
    case Action::SaveAs:
      ask_where_to_save();
      break;
    case Action::Quit:
      closing_ = may_discard(action);
      break;
    case Action::SaveAndContinue:
      perform_on_file(Action::Save);
      break;
    case Action::DiscardAndContinue:
      discard_ = true;
      perform_on_file(std::exchange(waiting_, Action::None));
      break;
    default:
      break;
  }
}

bool Application::may_discard(Action action) {
  if (!bench_.editor.dirty() || std::exchange(discard_, false)) return true;
  waiting_ = action;
  bench_.unsaved_asked = true;
  return false;
}

void Application::ask_where_to_save() {
  const Editor& editor = bench_.editor;
  bench_.file_dialog.ask(
      {"Save scene",
       true,
       editor.file().empty() ? editor.directory() / "untitled.json" : editor.file(),
       {".json"},
       [this](const std::filesystem::path& file) { save(file); }});
}

void Application::save(const std::filesystem::path& file) {
  bench_.editor.commit();
  bench_.jobs.run([this, scene = bench_.editor.scene, file]() -> BackgroundJobs::Finish {
    save_scene(scene, file);
    return [this, scene, file] {
      bench_.editor.saved(scene, file);
      bench_.notice = {};
      // What waited for this file to be safe goes on, unless the scene was edited meanwhile.
      if (const Action next = std::exchange(waiting_, Action::None); next != Action::None) {
        bench_.request(next);
      }
    };
  });
}

void Application::open(const std::filesystem::path& file) {
  bench_.jobs.run([this, file]() -> BackgroundJobs::Finish {
    Scene scene = load_scene(file);
    return [this, scene = std::move(scene), file] { show(scene, file); };
  });
}

void Application::show(Scene scene, const std::filesystem::path& file) {
  bench_.editor.open(std::move(scene), file);
  bench_.pivot.reset();
  bench_.view = {};
  bench_.notice = {};
}

}  // namespace lightbench::ui
