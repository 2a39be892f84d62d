// Walls of the scene's hull: which objects are, and that shadow rays lose nothing without them.

#include "core/compile/walls.h"

#include <gtest/gtest.h>

#include "app/proof/measure.h"
#include "core/compile/parts.h"
#include "core/compile/render_scene.h"
#include "core/compile/scene_reach.h"
#include "core/query/rays.h"
#include "core/scene/scene_io.h"
#include "tests/unit/changed_view.h"

namespace lightbench {
namespace {

std::vector<bool> walls(const Scene& scene) {
  return find_walls(scene, object_roles(scene), all_mesh_bounds(scene));
}

Object of(const Shape& shape) {
  Object o;
  o.shape = shape;
  o.material = 0;
  return o;
}

/// A unit room without front: floor, ceiling, left, right, back; then a ball that touches the
/// floor.
Scene room() {
  Scene scene;
  scene.materials.emplace_back();
  scene.materials.back().name = "grey";
  for (const RectangleShape& wall : {RectangleShape{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                     RectangleShape{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                     RectangleShape{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     RectangleShape{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     RectangleShape{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) {
    scene.objects.push_back(of(wall));
  }
  scene.objects.push_back(of(SphereShape{{0.5, 0.25, 0.5}, 0.25, {}}));
  return scene;
}

const std::vector<bool> kRoom = {true, true, true, true, true, false};

TEST(Walls, AreFlatAndHaveTheSceneOnOneSide) { EXPECT_EQ(walls(room()), kRoom); }

TEST(Walls, AreFoundHoweverTheSceneLies) {
  for (const double degrees : {10.0, 33.0, 71.5}) {
    Scene scene = room();
    for (Object& o : scene.objects) {
      o.transform.axis = {1, 2, -0.5};
      o.transform.degrees = degrees;
      o.transform.translation = {1e3, -20, 7};
      o.transform.scale = glm::dvec3(300);
    }
    EXPECT_EQ(walls(scene), kRoom) << degrees;
  }
}

TEST(Walls, HaveNothingBehindThem) {
  const auto with = [](const Object& o) {
    Scene scene = room();
    scene.objects.push_back(o);
    return walls(scene);
  };
  // Of all that is added only what lies under the floor makes it no wall, and itself a wall where
  // it is flat.
  EXPECT_FALSE(with(of(SphereShape{{0.5, -0.1, 0.5}, 0.05, {}}))[0]);
  EXPECT_FALSE(with(of(SphereShape{{0.5, 0.5, 0.5}, 0.05, {0, -1, 0}}))[0]) << "as it moves";
  EXPECT_FALSE(with(of(DiscShape{{0.5, -1e-9, 0.5}, {0, 1, 0}, 0.1}))[0]) << "just under it";
  EXPECT_TRUE(with(of(DiscShape{{0.5, -1e-9, 0.5}, {0, 1, 0}, 0.1}))[6]);
  EXPECT_TRUE(with(of(DiscShape{{0.5, 1e-9, 0.5}, {0, 1, 0}, 0.1}))[0]) << "just over it";
  EXPECT_FALSE(with(of(DiscShape{{0.5, 1e-9, 0.5}, {0, 1, 0}, 0.1}))[6]);
  EXPECT_TRUE(with(of(TriangleShape{{0.1, 0, 0.1}, {0.9, 0, 0.1}, {0.1, 0, 0.9}}))[0]) << "in it";
  Object hidden = of(SphereShape{{0.5, -0.1, 0.5}, 0.05, {}});
  hidden.visible = false;
  EXPECT_TRUE(with(hidden)[0]);
  // A cloud of fog has a boundary and no surface.
  Scene scene = room();
  scene.media.emplace_back();
  scene.media.back().name = "fog";
  Object fog = of(BoxShape{{0.2, -0.2, 0.2}, {0.4, 0.4, 0.4}});
  fog.material = -1;
  fog.medium = 0;
  scene.objects.push_back(fog);
  EXPECT_FALSE(walls(scene)[0]);
}

TEST(Walls, ChangeNoBitOfThePicturesOfRooms) {
  for (const char* name : {"cornell-box", "cornell-plain", "cornell-smoke", "quads"}) {
    Scene scene = load_scene(std::string(LIGHTBENCH_SOURCE_DIR "/scenes/") + name + ".json", {});
    scene.render.width = scene.render.height = 40;
    for (const KernelKind kernel : {KernelKind::Auto, KernelKind::Reference}) {
      const auto compiled = compile(scene, kernel);
      unsigned walls = 0;
      const RenderScene other = with_changed_view(*compiled, [&](auto& view) {
        for (unsigned k = 0; k < kPrimitiveKinds; ++k)
          walls += view.kind_begin[k + 1] - view.occluders_end[k];
        view = with_all_occluders(view);
      });
      EXPECT_GE(walls, 4U) << name;
      EXPECT_EQ(proof::render_film(*compiled, 8).hash(), proof::render_film(other, 8).hash())
          << name << " in " << kernel_name(kernel);
    }
  }
}

TEST(Walls, StopRaysThatComeFromOutside) {
  const auto compiled = compile(room(), KernelKind::Auto);
  Ray ray;
  ray.origin = {0.5, -1, 0.5};
  ray.direction = {0, 1, 0};
  EXPECT_TRUE(occluded(*compiled, ray));
}

}  // namespace
}  // namespace lightbench
