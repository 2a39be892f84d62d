#pragma once
// The scene and the options that change it before it is rendered: shared by all subcommands.

#include <filesystem>
#include <string>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

namespace CLI {
class App;
}

namespace lightbench {

/// As written by the user; empty = not given.
struct SceneOptions {
  std::string file;
  std::vector<std::string> definitions;
  std::string resolution;
  std::string crop;
  std::string depth;
  std::string seed;
  std::string exposure;
  bool adaptive = false, uniform = false;
  std::string kernel = "auto";
  std::string threads;
};

/// Separate: the subcommand declares its own.
enum class SceneArgument { Required, Optional, Separate };

/// Declares SCENE and the options on a subcommand.
void add_scene_options(CLI::App& app, SceneOptions& options, SceneArgument argument);

/// Reads and validates the scene with all options applied. Throws Error: Usage where a flag is at
/// fault, Scene where the file is.
Scene load_scene(const SceneOptions& options);

/// Checked `--kernel` and `--threads`. They throw Error{Usage}.
KernelKind chosen_kernel(const SceneOptions& options);
int chosen_threads(const SceneOptions& options);

}  // namespace lightbench
