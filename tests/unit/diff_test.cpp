// The table of what each edit touches: every field of a Scene, one row each.

#include <gtest/gtest.h>

#include <functional>

#include "core/scene/change.h"

namespace lightbench {
namespace {

Scene scene_with_everything() {
  Scene scene;
  scene.textures.resize(2);
  scene.materials.resize(2);
  scene.media.resize(2);
  scene.meshes.resize(2);
  scene.objects.resize(2);
  scene.objects[1].shape = MeshShape{0};
  return scene;
}

struct Edit {
  const char* what;
  Change expected;
  std::function<void(Scene&)> apply;
};

const std::vector<Edit>& edits() {
  using S = Scene&;
  static const std::vector<Edit> table{
      {"camera.look_from", Change::Camera, [](S s) { s.camera.look_from.x = 9; }},
      {"camera.look_at", Change::Camera, [](S s) { s.camera.look_at.y = 9; }},
      {"camera.up", Change::Camera, [](S s) { s.camera.up.z = 9; }},
      {"camera.vfov", Change::Camera, [](S s) { s.camera.vfov = 9; }},
      {"camera.sensor_height", Change::Display, [](S s) { s.camera.sensor_height = 9; }},
      {"camera.lens_radius", Change::Camera, [](S s) { s.camera.lens_radius = 9; }},
      {"camera.focus_distance", Change::Camera, [](S s) { s.camera.focus_distance = 9; }},
      {"camera.shutter_open", Change::Camera, [](S s) { s.camera.shutter_open = 0.5; }},
      {"camera.shutter_close", Change::Camera, [](S s) { s.camera.shutter_close = 0.5; }},
      {"render.width", Change::Resolution, [](S s) { s.render.width = 9; }},
      {"render.height", Change::Resolution, [](S s) { s.render.height = 9; }},
      {"render.crop.x", Change::Resolution, [](S s) { s.render.crop.x = 9; }},
      {"render.crop.y", Change::Resolution, [](S s) { s.render.crop.y = 9; }},
      {"render.crop.width", Change::Resolution, [](S s) { s.render.crop.width = 9; }},
      {"render.crop.height", Change::Resolution, [](S s) { s.render.crop.height = 9; }},
      {"render.spp", Change::Target, [](S s) { s.render.spp = 9; }},
      {"render.time_limit", Change::Target, [](S s) { s.render.time_limit = 9; }},
      {"render.snapshots", Change::Target, [](S s) { s.render.snapshots.push_back(9); }},
      {"render.max_depth", Change::Settings, [](S s) { s.render.max_depth = 9; }},
      {"render.roulette_depth", Change::Settings, [](S s) { s.render.roulette_depth = 9; }},
      {"render.lightChoice", Change::Settings,
       [](S s) { s.render.light_choice = LightChoiceBy::Power; }},
      {"render.sampler", Change::Settings,
       [](S s) { s.render.sampler = SamplerKind::Independent; }},
      {"render.strategy", Change::Settings, [](S s) { s.render.strategy = Strategy::Bsdf; }},
      {"render.seed", Change::Settings, [](S s) { s.render.seed = 9; }},
      {"render.adaptive", Change::Settings, [](S s) { s.render.adaptive = true; }},
      {"render.filter", Change::Settings, [](S s) { s.render.filter = FilterKind::Gaussian; }},
      {"render.filter_radius", Change::Settings, [](S s) { s.render.filter_radius = 9; }},
      {"display.exposure", Change::Display, [](S s) { s.display.exposure = 9; }},
      {"display.tone_map", Change::Display, [](S s) { s.display.tone_map = ToneMap::Aces; }},
      {"environment.kind", Change::Environment,
       [](S s) { s.environment.kind = EnvironmentKind::Gradient; }},
      {"environment.color", Change::Environment, [](S s) { s.environment.color.x = 9; }},
      {"environment.horizon", Change::Environment, [](S s) { s.environment.horizon.x = 9; }},
      {"environment.strength", Change::Environment, [](S s) { s.environment.strength = 9; }},
      {"environment.rotation", Change::Environment, [](S s) { s.environment.rotation = 9; }},
      {"environment.image", Change::Environment,
       [](S s) { s.environment.image = std::make_shared<const Texels>(); }},
      {"environment.file", Change::Display, [](S s) { s.environment.file = "x"; }},
      {"texture.name", Change::Display, [](S s) { s.textures[1].name = "x"; }},
      {"texture.file", Change::Display, [](S s) { s.textures[1].file = "x"; }},
      {"texture.kind", Change::Textures, [](S s) { s.textures[1].kind = TextureKind::Noise; }},
      {"texture.color_a", Change::Textures, [](S s) { s.textures[1].color_a.x = 0; }},
      {"texture.color_b", Change::Textures, [](S s) { s.textures[1].color_b.x = 0; }},
      {"texture.scale", Change::Textures, [](S s) { s.textures[1].scale = 9; }},
      {"texture.use_uv", Change::Textures, [](S s) { s.textures[1].use_uv = true; }},
      {"texture.octaves", Change::Textures, [](S s) { s.textures[1].octaves = 9; }},
      {"texture.seed", Change::Textures, [](S s) { s.textures[1].seed = 9; }},
      {"texture.wrap", Change::Textures, [](S s) { s.textures[1].wrap = WrapMode::Clamp; }},
      {"texture.srgb", Change::Textures, [](S s) { s.textures[1].srgb = false; }},
      {"texture.image", Change::Textures,
       [](S s) { s.textures[1].image = std::make_shared<const Texels>(); }},
      {"texture added", Change::Textures, [](S s) { s.textures.emplace_back(); }},
      {"material.name", Change::Display, [](S s) { s.materials[1].name = "x"; }},
      {"material.kind", Change::Materials,
       [](S s) { s.materials[1].kind = MaterialKind::Emissive; }},
      {"material.base_color", Change::Materials, [](S s) { s.materials[1].base_color.x = 0; }},
      {"material.base_color_texture", Change::Materials,
       [](S s) { s.materials[1].base_color_texture = 0; }},
      {"material.fuzz", Change::Materials, [](S s) { s.materials[1].fuzz = 0.5; }},
      {"material.roughness", Change::Materials, [](S s) { s.materials[1].roughness = 0.5; }},
      {"material.ior", Change::Materials, [](S s) { s.materials[1].ior = 9; }},
      {"material.emissive", Change::Materials, [](S s) { s.materials[1].emissive.x = 9; }},
      {"material.emissive_strength", Change::Materials,
       [](S s) { s.materials[1].emissive_strength = 9; }},
      {"material.emissive_texture", Change::Materials,
       [](S s) { s.materials[1].emissive_texture = 0; }},
      {"material.two_sided", Change::Materials, [](S s) { s.materials[1].two_sided = true; }},
      {"material added", Change::Materials, [](S s) { s.materials.emplace_back(); }},
      {"medium.name", Change::Display, [](S s) { s.media[1].name = "x"; }},
      {"medium.density", Change::Materials, [](S s) { s.media[1].density = 9; }},
      {"medium.albedo", Change::Materials, [](S s) { s.media[1].albedo.x = 0; }},
      {"medium removed", Change::Materials, [](S s) { s.media.pop_back(); }},
      {"mesh.name", Change::Display, [](S s) { s.meshes[1].name = "x"; }},
      {"mesh.file", Change::Display, [](S s) { s.meshes[1].file = "x"; }},
      {"mesh.data", Change::Meshes, [](S s) { s.meshes[1].data = std::make_shared<const Mesh>(); }},
      {"mesh added", Change::Meshes, [](S s) { s.meshes.emplace_back(); }},
      {"object.name", Change::Display, [](S s) { s.objects[1].name = "x"; }},
      {"object.shape parameter", Change::Geometry,
       [](S s) { std::get<SphereShape>(s.objects[0].shape).radius = 9; }},
      {"object.shape kind", Change::Geometry, [](S s) { s.objects[0].shape = BoxShape{}; }},
      {"object.shape mesh", Change::Geometry, [](S s) { s.objects[1].shape = MeshShape{1}; }},
      {"object.visible", Change::Geometry, [](S s) { s.objects[1].visible = false; }},
      {"object.transform.translation", Change::Transforms,
       [](S s) { s.objects[1].transform.translation.x = 9; }},
      {"object.transform.axis", Change::Transforms, [](S s) { s.objects[1].transform.axis.x = 9; }},
      {"object.transform.degrees", Change::Transforms,
       [](S s) { s.objects[1].transform.degrees = 9; }},
      {"object.transform.scale", Change::Transforms,
       [](S s) { s.objects[1].transform.scale.x = 9; }},
      {"object.material", Change::Materials, [](S s) { s.objects[1].material = 0; }},
      {"object.medium", Change::Materials, [](S s) { s.objects[1].medium = 0; }},
      {"object added", Change::Geometry, [](S s) { s.objects.emplace_back(); }},
      {"last object removed", Change::Geometry, [](S s) { s.objects.pop_back(); }},
  };
  return table;
}

TEST(Diff, EachEditTouchesExactlyWhatItShould) {
  const Scene before = scene_with_everything();
  for (const Edit& edit : edits()) {
    Scene after = before;
    edit.apply(after);
    ASSERT_FALSE(before == after) << edit.what;
    EXPECT_EQ(diff(before, after), edit.expected) << edit.what;
    EXPECT_EQ(diff(after, before), edit.expected) << edit.what << ", undone";
  }
}

TEST(Diff, EditsAddUp) {
  const Scene before = scene_with_everything();
  Scene after = before;
  Change expected = Change::None;
  for (const Edit& edit : edits()) {
    if (std::string(edit.what).find("removed") != std::string::npos) continue;
    edit.apply(after);
    expected |= edit.expected;
  }
  EXPECT_EQ(expected, Change::All);
  EXPECT_EQ(diff(before, after), Change::All);
}

TEST(Diff, ACopyIsNoChange) {
  const Scene before = scene_with_everything();
  const Scene after = before;
  EXPECT_EQ(diff(before, after), Change::None);
}

TEST(Diff, EqualPayloadsAreTheSamePointer) {
  Scene before = scene_with_everything();
  before.meshes[0].data = std::make_shared<const Mesh>();
  Scene after = before;
  EXPECT_EQ(diff(before, after), Change::None);
  after.meshes[0].data = std::make_shared<const Mesh>();
  EXPECT_EQ(diff(before, after), Change::Meshes);
}

TEST(Diff, OnlyPicturesThatChangeResetTheFilm) {
  for (const Edit& edit : edits()) {
    const bool kept = edit.expected == Change::Display || edit.expected == Change::Target;
    EXPECT_EQ(resets_film(edit.expected), !kept) << edit.what;
  }
  EXPECT_FALSE(resets_film(Change::Display | Change::Target));
  EXPECT_TRUE(resets_film(Change::Display | Change::Camera));
}

}  // namespace
}  // namespace lightbench
