#include "tests/unit/small_scenes.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/scene/scene_io.h"

namespace lightbench {

std::vector<std::pair<std::string, Scene>> small_scenes(int width, int height) {
  const std::filesystem::path folder = std::filesystem::path(LIGHTBENCH_SOURCE_DIR) / "scenes";
  std::vector<std::filesystem::path> files{folder / "cornell-three-lights.json",
                                           folder / "cornell-smoke.json"};
  for (const auto& entry : std::filesystem::directory_iterator(folder / "features")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::vector<std::pair<std::string, Scene>> scenes;
  for (const auto& file : files) {
    Scene scene = load_scene(file);
    scene.render.width = width;
    scene.render.height = height;
    scene.render.crop = {};
    scene.render.seed = 5;
    scenes.emplace_back(file.stem().string(), std::move(scene));
  }
  EXPECT_GT(scenes.size(), 10U);
  return scenes;
}

}  // namespace lightbench
