#include "ui/scene_edit.h"

#include <gtest/gtest.h>

#include "core/scene/scene_io.h"

namespace lightbench::ui {
namespace {

Scene scene_with_everything() {
  Scene scene = new_scene();
  add_light(scene);
  add_texture(scene, TextureKind::Checker);
  add_texture(scene, TextureKind::Marble);
  add_medium(scene);
  scene.materials[0].base_color_texture = 0;
  scene.materials[1].base_color_texture = 1;
  scene.materials[1].emissive_texture = 0;
  scene.objects[1].medium = 0;
  return scene;
}

TEST(SceneEdit, NewSceneAndEveryShapeAreValid) {
  Scene scene = new_scene();
  for (std::size_t shape = 0; shape + 1 < shape_names().size(); ++shape) {
    const Selection added = add_object(scene, shape);
    EXPECT_EQ(scene.objects[static_cast<std::size_t>(added.index)].shape.index(), shape);
  }
  EXPECT_NO_THROW(validate(scene));
}

TEST(SceneEdit, EveryMaterialTextureAndMediumIsValid) {
  Scene scene = scene_with_everything();
  for (int kind = 0; kind < 4; ++kind) add_material(scene, static_cast<MaterialKind>(kind));
  EXPECT_NO_THROW(validate(scene));
}

TEST(SceneEdit, AddedLightIsALight) {
  Scene scene = new_scene();
  const Selection light = add_light(scene);
  const Object& object = scene.objects[static_cast<std::size_t>(light.index)];
  EXPECT_TRUE(emits(scene.materials[static_cast<std::size_t>(object.material)]));
}

TEST(SceneEdit, NamesStayUnique) {
  Scene scene = new_scene();
  const Selection first = add_object(scene, 0);
  const Selection second = add_object(scene, 0);
  EXPECT_EQ(item_name(scene, first), "Sphere 2");
  EXPECT_EQ(item_name(scene, second), "Sphere 3");
  rename(scene, second, "Floor");
  EXPECT_EQ(item_name(scene, second), "Floor 2");
  rename(scene, second, "");
  EXPECT_EQ(item_name(scene, second), "Floor 2");
  EXPECT_NO_THROW(validate(scene));
}

TEST(SceneEdit, RemovingAMaterialLeavesObjectsWithOne) {
  Scene scene = scene_with_everything();
  while (!scene.materials.empty()) {
    const std::size_t before = scene.materials.size();
    remove(scene, {ItemKind::Material, 0});
    EXPECT_NO_THROW(validate(scene));
    for (const Object& object : scene.objects) EXPECT_NE(object.material, kNone);
    if (scene.materials.size() == before) break;  // the last one in use is replaced
  }
  EXPECT_EQ(scene.materials.size(), 1U);
}

TEST(SceneEdit, RemovingKeepsOtherReferences) {
  Scene scene = scene_with_everything();
  const std::string name = scene.materials[1].name;
  remove(scene, {ItemKind::Material, 0});
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[1].material)].name, name);
  remove(scene, {ItemKind::Texture, 0});
  EXPECT_EQ(scene.materials[0].base_color_texture, 0);
  EXPECT_EQ(scene.materials[0].emissive_texture, kNone);
  remove(scene, {ItemKind::Medium, 0});
  EXPECT_EQ(scene.objects[1].medium, kNone);
  EXPECT_NO_THROW(validate(scene));
}

TEST(SceneEdit, RemovingTheMediumOfABareBoundaryGivesItASurface) {
  Scene scene = scene_with_everything();
  scene.objects[1].material = kNone;
  remove(scene, {ItemKind::Medium, 0});
  EXPECT_NE(scene.objects[1].material, kNone);
}

TEST(SceneEdit, DuplicateComesRightAfterAndKeepsReferences) {
  Scene scene = scene_with_everything();
  const std::string used =
      scene.materials[static_cast<std::size_t>(scene.objects[1].material)].name;
  const Selection copy = duplicate(scene, {ItemKind::Material, 0});
  EXPECT_EQ(copy.index, 1);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[1].material)].name, used);
  const Selection object = duplicate(scene, {ItemKind::Object, 1});
  EXPECT_NE(scene.objects[1].transform,
            scene.objects[static_cast<std::size_t>(object.index)].transform);
  EXPECT_NO_THROW(validate(scene));
}

TEST(SceneEdit, MakeUniqueSeparatesObjectsThatShareAMaterial) {
  Scene scene = new_scene();
  scene.objects[1].material = 0;
  EXPECT_EQ(use_count(scene, {ItemKind::Material, 0}), 2);
  make_material_unique(scene, 1);
  EXPECT_NE(scene.objects[0].material, scene.objects[1].material);
  EXPECT_NO_THROW(validate(scene));
}

}  // namespace
}  // namespace lightbench::ui
