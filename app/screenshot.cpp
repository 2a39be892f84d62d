// lightbench screenshot: the whole interface as an image, without a display.

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/parse.h"
#include "app/scene_options.h"
#include "core/error.h"
#include "core/film/image_file.h"
#include "ui/script.h"

namespace lightbench {
namespace {

struct ScreenshotOptions {
  SceneOptions scene;
  std::string output;
  std::string size = "1280x720";
  int spp = 16;
  double ui_scale = 1;
  std::string script;
  bool quiet = false;
};

nlohmann::json read_script(const std::string& file) {
  if (file.empty()) return nlohmann::json::array();
  std::ifstream stream(file);
  if (!stream) throw Error(ErrorKind::Usage, "--script " + file + ": cannot be read");
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::Usage, "--script " + file + ": " + error.what());
  }
}

int screenshot(const ScreenshotOptions& options) {
  check_image_name(options.output);
  const Resolution size = parse_resolution("--size", options.size);
  const nlohmann::json script = read_script(options.script);
  Scene scene = load_scene(options.scene);
  scene.render.spp = options.spp;
  ui::GlContext gl(ui::GlBackend::OSMesa, size.width, size.height, "");
  ui::ApplicationOptions application_options;
  application_options.threads = chosen_threads(options.scene);
  application_options.kernel = chosen_kernel(options.scene);
  application_options.scale = options.ui_scale;
  // A picture of the interface leaves nothing behind but itself.
  application_options.write_snapshots = false;
  ui::Application application(gl, std::move(scene), options.scene.file, application_options, [] {});
  // One line, rewritten, for a person; a log gets only the last.
  const bool live = !options.quiet && isatty(STDERR_FILENO) != 0;
  const auto report = [&](std::uint32_t spp) {
    if (live) fmt::print(stderr, "\r{} / {} spp", spp, options.spp);
  };
  ui::wait_for_samples(application, static_cast<std::uint32_t>(options.spp), report);
  if (!options.quiet) fmt::print(stderr, "{0}{1} / {1} spp\n", live ? "\r" : "", options.spp);
  ui::run_script(application, gl, script);
  for (int i = 0; i < 3; ++i) ui::step_frame(application);
  ui::write_screenshot(gl, options.output);
  return 0;
}

}  // namespace

void add_screenshot(CLI::App& app, Action& action) {
  CLI::App& command =
      *app.add_subcommand("screenshot", "Draw the whole interface to an image, without a display");
  auto options = std::make_shared<ScreenshotOptions>();
  add_scene_options(command, options->scene, SceneArgument::Required);
  command.add_option("-o,--output", options->output, "Image of the interface (PNG or PPM)")
      ->required()
      ->type_name("FILE");
  command.add_option("--size", options->size, "Size of the interface in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command.add_option("--spp", options->spp, "Samples per pixel to wait for")
      ->check(CLI::Range(1, 1'000'000))
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--ui-scale", options->ui_scale, "Pixels per layout unit")
      ->check(CLI::Range(0.5, 4.0))
      ->type_name("FACTOR")
      ->capture_default_str();
  command
      .add_option("--script", options->script,
                  "Clicks and edits to make before the image is taken (docs/viewer.md)")
      ->type_name("FILE");
  command.add_flag("-q,--quiet", options->quiet, "No progress");
  command.callback([&action, options] { action = [options] { return screenshot(*options); }; });
}

}  // namespace lightbench
