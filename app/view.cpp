// lightbench view: the editor in a window.

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.h"
#include "app/scene_options.h"
#include "ui/scene_edit.h"
#include "ui/window_loop.h"

namespace lightbench {
namespace {

struct ViewOptions {
  SceneOptions scene;
  double ui_scale = 0;
};

int view(const ViewOptions& options) {
  ui::ApplicationOptions application;
  application.threads = chosen_threads(options.scene);
  application.kernel = chosen_kernel(options.scene);
  application.scale = options.ui_scale;
  application.layout_file = ui::default_layout_file();
  const bool given = !options.scene.file.empty();
  ui::run_window(given ? load_scene(options.scene) : ui::new_scene(), options.scene.file,
                 application);
  return 0;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  CLI::App& command = *app.add_subcommand("view", "Edit a scene in a window while it renders");
  auto options = std::make_shared<ViewOptions>();
  options->scene.threads = "-1";  // the window needs a core of its own to stay smooth
  add_scene_options(command, options->scene, SceneArgument::Optional);
  command
      .add_option("--ui-scale", options->ui_scale,
                  "Pixels per layout unit; what the desktop asks for if not given")
      ->type_name("FACTOR")
      ->check(CLI::Range(0.5, 4.0));
  command.callback([&action, options] { action = [options] { return view(*options); }; });
}

}  // namespace lightbench
