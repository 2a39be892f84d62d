// The scenes in scenes/: each loads, each generated file is what its generator writes, and the few
// that other tests and people rely on are what they claim to be.

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "core/scene/change.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(LIGHTBENCH_SOURCE_DIR) / "scenes";

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(kScenes)) {
    if (entry.path().extension() == ".json") {
      names.push_back(fs::relative(entry.path(), kScenes).generic_string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Letters and digits only, as GoogleTest wants.
std::string test_name(const testing::TestParamInfo<std::string>& scene) {
  std::string name = fs::path(scene.param).replace_extension().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

Scene load(const std::string& name) { return load_scene(kScenes / name); }

std::string contents(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The first object of that name; fails the test with an exception if there is none.
std::size_t object_named(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].name == name) {
      return i;
    }
  }
  throw std::runtime_error("no object " + name);
}

class SceneFile : public testing::TestWithParam<std::string> {};

TEST_P(SceneFile, LoadsAndHasSomethingToShow) {
  const Scene scene = load(GetParam());
  EXPECT_FALSE(scene.objects.empty());
  bool lit = scene.environment.kind != EnvironmentKind::Constant ||
             scene.environment.color != glm::dvec3(0);
  for (const Object& object : scene.objects) {
    lit = lit || (object.material != kNone &&
                  emits(scene.materials[static_cast<std::size_t>(object.material)]));
    EXPECT_FALSE(object.name.empty());
  }
  EXPECT_TRUE(lit) << "no light and no environment";
  for (const Texture& texture : scene.textures) {
    EXPECT_EQ(texture.kind == TextureKind::Image, texture.image != nullptr) << texture.name;
  }
  for (const MeshAsset& mesh : scene.meshes) {
    EXPECT_NE(mesh.data, nullptr) << mesh.name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, SceneFile, testing::ValuesIn(scene_names()), test_name);

TEST(SceneFiles, GeneratedOnesAreWhatTheirGeneratorWrites) {
  const fs::path out =
      fs::temp_directory_path() / ("lightbench-scenes-" + std::to_string(getpid()));
  const std::string command =
      "python3 '" + (kScenes / "generate/all.py").string() + "' '" + out.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out)) {
    if (entry.is_regular_file()) {
      const fs::path name = fs::relative(entry.path(), out);
      EXPECT_TRUE(contents(entry.path()) == contents(kScenes / name)) << name << " differs";
      ++files;
    }
  }
  EXPECT_GE(files, 25);
  fs::remove_all(out);
}

TEST(SceneFiles, CornellLightsFaceTheirTargets) {
  const Scene scene = load("cornell-three-lights.json");
  const struct {
    const char* name;
    glm::dvec3 center, target;
  } lights[] = {{"ceiling light", {278, 554, 279}, {278, 0, 279}},
                {"green corner light", {500, 500, 500}, {0, 0, 0}},
                {"red corner light", {60, 500, 500}, {500, 0, 0}}};
  for (const auto& light : lights) {
    const Object& object = scene.objects[object_named(scene, light.name)];
    const auto& disc = std::get<DiscShape>(object.shape);
    EXPECT_EQ(disc.center, light.center);
    EXPECT_EQ(disc.radius, 60);
    const glm::dvec3 aim = glm::normalize(light.target - light.center);
    EXPECT_NEAR(glm::dot(glm::normalize(disc.normal), aim), 1, 1e-12) << light.name;
    EXPECT_FALSE(scene.materials[static_cast<std::size_t>(object.material)].two_sided);
  }
}

TEST(SceneFiles, StaticCornellOnlyHoldsTheMovingSphere) {
  Scene moving = load("cornell-three-lights.json");
  Object& object = moving.objects[object_named(moving, "moving sphere")];
  auto& sphere = std::get<SphereShape>(object.shape);
  ASSERT_EQ(sphere.motion, glm::dvec3(30, 0, 0));
  sphere.motion = glm::dvec3(0);
  const Change change = diff(moving, load("cornell-three-lights-static.json"));
  // The two files load the Earth twice, and payloads are compared by pointer.
  EXPECT_EQ(
      change & static_cast<Change>(~static_cast<std::uint32_t>(Change::Textures | Change::Display)),
      Change::None);
}

TEST(SceneFiles, OneWeekendHas485Spheres) {
  const Scene scene = load("one-weekend-final.json");
  std::size_t spheres = 0;
  for (const Object& object : scene.objects) {
    spheres += std::holds_alternative<SphereShape>(object.shape) ? 1 : 0;
  }
  EXPECT_EQ(spheres, 485U);
  EXPECT_EQ(scene.objects.size(), 485U);
}

TEST(SceneFiles, NextWeekHasItsCrowdsAndMedia) {
  const Scene scene = load("next-week-final.json");
  std::size_t boxes = 0;
  std::size_t crowd = 0;
  std::size_t media = 0;
  for (const Object& object : scene.objects) {
    boxes += std::holds_alternative<BoxShape>(object.shape) ? 1 : 0;
    crowd += object.name.rfind("crowd", 0) == 0 ? 1 : 0;
    media += object.medium != kNone ? 1 : 0;
  }
  EXPECT_EQ(boxes, 400U);
  EXPECT_EQ(crowd, 1000U);
  EXPECT_EQ(media, 2U);
}

}  // namespace
}  // namespace lightbench
