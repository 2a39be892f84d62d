#pragma once
// Scenes as JSON files (docs/scene-format.md). Every function throws Error{Scene} or Error{Output}
// with one line that names the file and the JSON pointer and says what was expected.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

/// A value to place at a JSON pointer before the scene is read: `-D /render/spp=20`.
struct Override {
  std::string pointer;
  std::string value;  ///< JSON, or a bare word taken as a string
};

/// Reads, overrides, validates, and loads the textures and meshes it names (relative to the file).
Scene load_scene(const std::filesystem::path& file, const std::vector<Override>& overrides = {});

/// Same for text in memory; `directory` resolves relative names, `label` stands for the file name.
Scene parse_scene(const std::string& text, const std::filesystem::path& directory,
                  const std::string& label, const std::vector<Override>& overrides = {});

/// The document that load_scene reads back to an equal Scene. Defaults are omitted. Asset names are
/// rewritten relative to `directory`.
std::string scene_to_json(const Scene& scene, const std::filesystem::path& directory);

/// Writes to a temporary name, then renames.
void save_scene(const Scene& scene, const std::filesystem::path& file);

/// Throws Error{Scene} that names the first field out of range ("/objects/3/radius: ..."). The UI
/// calls it after an edit, load_scene after a read.
void validate(const Scene& scene);

/// Loads one mesh (PLY, OBJ, ... through assimp) or one image (PNG, JPEG, HDR, EXR,
/// PFM, PPM) for the editor. Texels are made finite and not negative, at most 1e12.
std::shared_ptr<const Mesh> load_mesh(const std::filesystem::path& file);
std::shared_ptr<const Texels> load_image(const std::filesystem::path& file, bool srgb);

}  // namespace lightbench
