#include "app/scene_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <functional>

#include "app/parse.h"
#include "core/error.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

template <class Number>
Number parse_number(const std::string& flag, const std::string& text, Number low, Number high,
                    const char* expected) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // The negation also catches NaN.
  if (error != std::errc() || end != text.data() + text.size() ||
      !(value >= low && value <= high)) {
    throw Error(ErrorKind::Usage, fmt::format("{} '{}': expected {}", flag, text, expected));
  }
  return value;
}

/// Applies one flag; a scene that is invalid afterwards is the flag's fault, not the file's.
void apply(Scene& scene, const std::string& flag, const std::string& text,
           const std::function<void(const std::string& flag, const std::string& text)>& set) {
  if (text.empty()) return;
  set(flag, text);
  try {
    validate(scene);
  } catch (const Error& error) {
    throw Error(ErrorKind::Usage, fmt::format("{} '{}': {}", flag, text, error.what()));
  }
}

}  // namespace

void add_scene_options(CLI::App& app, SceneOptions& options, SceneArgument argument) {
  if (argument != SceneArgument::Separate) {
    auto* scene = app.add_option("SCENE", options.file, "Scene file (JSON)")->type_name("FILE");
    if (argument == SceneArgument::Required) scene->required();
  }
  app.add_option("-D,--set", options.definitions,
                 "Set a value of the scene file before it is read; may be repeated")
      ->type_name("/POINTER=VALUE")
      ->allow_extra_args(false);
  app.add_option("-r,--resolution", options.resolution, "Picture size: 1280x720, 720p, 4K, ...")
      ->type_name("WxH");
  app.add_option("--crop", options.crop, "Render only this window of the picture")
      ->type_name("X,Y,W,H");
  app.add_option("--depth", options.depth, "Longest path, in segments from the camera")
      ->type_name("N");
  app.add_option("--seed", options.seed, "Seed of the random numbers")->type_name("N");
  app.add_option("--exposure", options.exposure, "Exposure of PNG and PPM output")
      ->type_name("STOPS");
  CLI::Option* adaptive =
      app.add_flag("--adaptive", options.adaptive, "More samples where there is more noise");
  app.add_flag("--no-adaptive", options.uniform, "As many samples for each pixel")
      ->excludes(adaptive);
  app.add_option("-t,--threads", options.threads,
                 "Rendering threads: 0 = all, negative = all minus that many")
      ->type_name("N");
  app.add_option("--kernel", options.kernel,
                 "Build of the tracer: auto, float, double, or a name that --version lists")
      ->type_name("NAME")
      ->capture_default_str();
}

Scene load_scene(const SceneOptions& options) {
  std::vector<Override> overrides;
  for (const std::string& definition : options.definitions) {
    auto [pointer, value] = parse_definition("-D", definition);
    overrides.push_back({std::move(pointer), std::move(value)});
  }
  Scene scene = load_scene(std::filesystem::path(options.file), overrides);
  RenderSettings& render = scene.render;
  apply(scene, "--resolution", options.resolution, [&](const auto& flag, const auto& text) {
    const Resolution resolution = parse_resolution(flag, text);
    render.width = resolution.width;
    render.height = resolution.height;
    render.crop = {};  // a window in pixels of another picture means nothing here
  });
  apply(scene, "--crop", options.crop,
        [&](const auto& flag, const auto& text) { render.crop = parse_crop(flag, text); });
  apply(scene, "--depth", options.depth, [&](const auto& flag, const auto& text) {
    render.max_depth = parse_number(flag, text, 1, 1'000'000, "a whole number above 0");
  });
  apply(scene, "--seed", options.seed, [&](const auto& flag, const auto& text) {
    render.seed = parse_number<std::uint32_t>(flag, text, 0, UINT32_MAX,
                                              "a whole number from 0 to 4294967295");
  });
  if (options.adaptive || options.uniform) render.adaptive = options.adaptive;
  apply(scene, "--exposure", options.exposure, [&](const auto& flag, const auto& text) {
    scene.display.exposure =
        parse_number(flag, text, -100.0, 100.0, "a number of stops from -100 to 100");
  });
  return scene;
}

KernelKind chosen_kernel(const SceneOptions& options) {
  return parse_kernel("--kernel", options.kernel);
}

int chosen_threads(const SceneOptions& options) {
  if (options.threads.empty()) return 0;
  return parse_number("--threads", options.threads, -4096, 4096,
                      "a whole number: 0 = all, negative = all minus that many, at most 4096");
}

}  // namespace lightbench
