// Every range in core/scene/scene.h, from the editor's side: a Scene value with one bad field.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Mesh one_triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

Scene good_scene() {
  Scene scene;
  scene.textures.emplace_back().name = "t";
  scene.materials.emplace_back().name = "m";
  scene.media.emplace_back().name = "fog";
  scene.meshes.emplace_back().name = "tri";
  scene.meshes[0].data = std::make_shared<const Mesh>(one_triangle());
  scene.objects.emplace_back();
  return scene;
}

std::string error_of(const Scene& scene) {
  try {
    validate(scene);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    return error.what();
  }
  return "no error";
}

struct BadValue {
  std::function<void(Scene&)> apply;
  const char* message;
};

void expect_errors(const std::vector<BadValue>& rows) {
  for (const BadValue& row : rows) {
    Scene scene = good_scene();
    row.apply(scene);
    EXPECT_EQ(error_of(scene), row.message);
  }
}

void set_shape(Scene& scene, const Shape& shape) { scene.objects[0].shape = shape; }

void set_mesh(Scene& scene, const std::function<void(Mesh&)>& edit) {
  Mesh mesh = one_triangle();
  edit(mesh);
  scene.meshes[0].data = std::make_shared<const Mesh>(std::move(mesh));
}

TEST(Validate, AcceptsDefaultsAndEmptyScenes) {
  EXPECT_EQ(error_of(Scene{}), "no error");
  EXPECT_EQ(error_of(good_scene()), "no error");
}

TEST(Validate, AcceptsTheEndsOfRanges) {
  Scene scene = good_scene();
  scene.camera.vfov = 179.9;
  scene.camera.shutter_open = scene.camera.shutter_close = 0.5;
  scene.render.width = 65536;
  scene.render.height = 4096;
  scene.render.crop = {65535, 4095, 1, 1};
  scene.render.spp = 0;
  scene.render.max_depth = 1;
  scene.render.roulette_depth = 0;
  scene.render.snapshots = {1, 1'000'000'000};
  scene.materials[0].fuzz = 1;
  scene.materials[0].base_color = {0, 1, 0};
  scene.textures[0].octaves = 16;
  scene.objects[0].shape = SphereShape{{1e18, -1e18, 0}, 1e-18, {}};
  scene.objects[0].transform.scale = {-1e-12, 1e12, -1};
  EXPECT_EQ(error_of(scene), "no error");
}

TEST(Validate, Camera) {
  using S = Scene&;
  expect_errors({
      {[](S s) { s.camera.look_from.x = kNan; },
       "/camera/lookFrom: expected finite components of at most 1e+18, got [nan, 1, 5]"},
      {[](S s) { s.camera.look_at.y = kInfinity; },
       "/camera/lookAt: expected finite components of at most 1e+18, got [0, inf, 0]"},
      {[](S s) { s.camera.look_from = s.camera.look_at; },
       "/camera/lookAt: expected a point other than lookFrom, got [0, 0, 0]"},
      {[](S s) {
         s.camera.up = {0, 0, 0};
       },
       "/camera/up: expected a vector that is not zero, got [0, 0, 0]"},
      {[](S s) {
         s.camera.up = {0, -2, -10};
       },
       "/camera/up: expected a direction not parallel to the view from lookFrom to lookAt, got "
       "[0, -2, -10]"},
      {[](S s) { s.camera.vfov = 0; },
       "/camera/vfov: expected an angle between 0 and 180 degrees, got 0"},
      {[](S s) { s.camera.vfov = 180; },
       "/camera/vfov: expected an angle between 0 and 180 degrees, got 180"},
      {[](S s) { s.camera.vfov = kNan; },
       "/camera/vfov: expected an angle between 0 and 180 degrees, got nan"},
      {[](S s) { s.camera.sensor_height = 0; },
       "/camera/sensorHeight: expected a positive number, got 0"},
      {[](S s) { s.camera.lens_radius = -1; },
       "/camera/lensRadius: expected a number from 0 to 1e+18, got -1"},
      {[](S s) { s.camera.focus_distance = 0; },
       "/camera/focusDistance: expected a positive number, got 0"},
      {[](S s) { s.camera.focus_distance = kInfinity; },
       "/camera/focusDistance: expected a number from 1e-18 to 1e+18, got inf"},
      {[](S s) { s.camera.shutter_open = 2; },
       "/camera/shutter: expected open before close, got [2, 1]"},
      {[](S s) { s.camera.shutter_close = kNan; },
       "/camera/shutter: expected a number from -1000000 to 1000000, got nan"},
  });
}

TEST(Validate, RenderAndDisplay) {
  using S = Scene&;
  expect_errors({
      {[](S s) { s.render.width = 0; },
       "/render/resolution: expected a number from 1 to 65536, got 0"},
      {[](S s) { s.render.height = 65537; },
       "/render/resolution: expected a number from 1 to 65536, got 65537"},
      {[](S s) { s.render.width = s.render.height = 65536; },
       "/render/resolution: expected at most 268435456 pixels, got 65536 x 65536"},
      {[](S s) {
         s.render.crop = {0, 0, 601, 1};
       },
       "/render/crop: expected [x, y, width, height] inside 600 x 600 pixels, got [0, 0, 601, 1]"},
      {[](S s) {
         s.render.crop = {-1, 0, 5, 5};
       },
       "/render/crop: expected [x, y, width, height] inside 600 x 600 pixels, got [-1, 0, 5, 5]"},
      {[](S s) {
         s.render.crop = {0, 0, 5, 0};
       },
       "/render/crop: expected [x, y, width, height] inside 600 x 600 pixels, got [0, 0, 5, 0]"},
      {[](S s) {
         s.render.crop = {2147483647, 0, 2147483647, 5};
       },
       "/render/crop: expected [x, y, width, height] inside 600 x 600 pixels, got [2147483647, 0, "
       "2147483647, 5]"},
      {[](S s) { s.render.spp = -1; },
       "/render/spp: expected a number from 0 to 1000000000, got -1"},
      {[](S s) { s.render.time_limit = -1; },
       "/render/timeLimit: expected a number of at least 0, got -1"},
      {[](S s) { s.render.time_limit = kInfinity; },
       "/render/timeLimit: expected a number of at least 0, got inf"},
      {[](S s) { s.render.max_depth = 0; },
       "/render/maxDepth: expected a number from 1 to 10000, got 0"},
      {[](S s) { s.render.roulette_depth = -1; },
       "/render/rouletteDepth: expected a number from 0 to 10000, got -1"},
      {[](S s) { s.render.filter_radius = 0; },
       "/render/filter/radius: expected a positive number, got 0"},
      {[](S s) { s.render.filter_radius = 17; },
       "/render/filter/radius: expected a number from 0 to 16, got 17"},
      {[](S s) {
         s.render.snapshots = {10, 0};
       },
       "/render/snapshots: expected a number from 1 to 1000000000, got 0"},
      {[](S s) { s.render.snapshots.assign(1001, 5); },
       "/render/snapshots: expected at most 1000 counts, got 1001"},
      {[](S s) { s.display.exposure = kNan; },
       "/display/exposure: expected a number from -100 to 100, got nan"},
  });
}

TEST(Validate, Appearance) {
  using S = Scene&;
  expect_errors({
      {[](S s) { s.environment.color.z = -1; },
       "/environment/color: expected components from 0 to 1000000000000, got [0, 0, -1]"},
      {[](S s) { s.environment.horizon.z = kNan; },
       "/environment/horizon: expected components from 0 to 1000000000000, got [1, 1, nan]"},
      {[](S s) { s.environment.strength = -1; },
       "/environment/strength: expected a number from 0 to 1000000000000, got -1"},
      {[](S s) { s.environment.rotation = kNan; },
       "/environment/rotation: expected a number from -1000000 to 1000000, got nan"},
      {[](S s) { s.environment.kind = EnvironmentKind::Image; },
       "/environment/file: expected an image file, got none"},
      {[](S s) { s.textures[0].color_a.x = 1.5; },
       "/textures/0/colorA: expected components from 0 to 1, got [1.5, 0.9, 0.9]"},
      {[](S s) { s.textures[0].color_b.x = -1; },
       "/textures/0/colorB: expected components from 0 to 1, got [-1, 0.1, 0.1]"},
      {[](S s) { s.textures[0].scale = 0; },
       "/textures/0/scale: expected a positive number, got 0"},
      {[](S s) { s.textures[0].octaves = 17; },
       "/textures/0/octaves: expected a number from 1 to 16, got 17"},
      {[](S s) { s.textures[0].kind = TextureKind::Image; },
       "/textures/0/file: expected an image file, got none"},
      {[](S s) { s.textures[0].name.clear(); }, "/textures/0/name: expected a name, got \"\""},
      {[](S s) {
         s.materials[0].base_color = {0.5, 1.01, 0};
       },
       "/materials/0/baseColor: expected components from 0 to 1, got [0.5, 1.01, 0]"},
      {[](S s) { s.materials[0].base_color_texture = 1; },
       "/materials/0/baseColorTexture: expected -1 or an index below 1, got 1"},
      {[](S s) { s.materials[0].emissive_texture = -2; },
       "/materials/0/emissiveTexture: expected -1 or an index below 1, got -2"},
      {[](S s) { s.materials[0].fuzz = 1.5; },
       "/materials/0/fuzz: expected a number from 0 to 1, got 1.5"},
      {[](S s) { s.materials[0].roughness = -0.5; },
       "/materials/0/roughness: expected a number from 0 to 1, got -0.5"},
      {[](S s) { s.materials[0].fuzz = s.materials[0].roughness = 0.5; },
       "/materials/0/roughness: expected 0 with fuzz above 0 (they exclude each other), got 0.5"},
      {[](S s) { s.materials[0].ior = 0; }, "/materials/0/ior: expected a positive number, got 0"},
      {[](S s) { s.materials[0].ior = 101; },
       "/materials/0/ior: expected a number from 0.01 to 100, got 101"},
      {[](S s) { s.materials[0].emissive.x = -1; },
       "/materials/0/emissive: expected components from 0 to 1000000000000, got [-1, 0, 0]"},
      {[](S s) { s.materials[0].emissive_strength = kInfinity; },
       "/materials/0/emissiveStrength: expected a number from 0 to 1000000000000, got inf"},
      {[](S s) { s.media[0].density = 0; }, "/media/0/density: expected a positive number, got 0"},
      {[](S s) { s.media[0].albedo.x = 2; },
       "/media/0/albedo: expected components from 0 to 1, got [2, 1, 1]"},
  });
}

TEST(Validate, Shapes) {
  using S = Scene&;
  expect_errors({
      {[](S s) {
         set_shape(s, SphereShape{{0, 0, 0}, 0, {}});
       },
       "/objects/0/radius: expected a positive number, got 0"},
      {[](S s) {
         set_shape(s, SphereShape{{0, 0, 0}, kNan, {}});
       },
       "/objects/0/radius: expected a positive number, got nan"},
      {[](S s) {
         set_shape(s, SphereShape{{0, 0, 0}, 1e19, {}});
       },
       "/objects/0/radius: expected a number from 1e-18 to 1e+18, got 1e+19"},
      {[](S s) {
         set_shape(s, SphereShape{{0, 0, 0}, 1, {kInfinity, 0, 0}});
       },
       "/objects/0/motion: expected finite components of at most 1e+18, got [inf, 0, 0]"},
      {[](S s) {
         set_shape(s, CylinderShape{{1, 2, 3}, {1, 2, 3}, 1});
       },
       "/objects/0/p1: expected a point other than p0, got [1, 2, 3]"},
      {[](S s) {
         set_shape(s, CylinderShape{{1, 2, 3}, {1, 2, 4}, -1});
       },
       "/objects/0/radius: expected a positive number, got -1"},
      {[](S s) {
         set_shape(s, DiscShape{{0, 0, 0}, {0, 0, 0}, 1});
       },
       "/objects/0/normal: expected a vector that is not zero, got [0, 0, 0]"},
      {[](S s) {
         set_shape(s, DiscShape{{0, 0, 0}, {0, 0, 1}, 0});
       },
       "/objects/0/radius: expected a positive number, got 0"},
      {[](S s) {
         set_shape(s, RectangleShape{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}});
       },
       "/objects/0/edgeU: expected a vector that is not zero, got [0, 0, 0]"},
      {[](S s) {
         set_shape(s, RectangleShape{{0, 0, 0}, {1, 2, 3}, {-2, -4, -6}});
       },
       "/objects/0/edgeV: expected an edge not parallel to edgeU, got [-2, -4, -6]"},
      {[](S s) {
         set_shape(s, TriangleShape{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}});
       },
       "/objects/0/b: expected a point other than a, got [0, 0, 0]"},
      {[](S s) {
         set_shape(s, TriangleShape{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
       },
       "/objects/0/c: expected a point off the line through a and b, got [2, 2, 2]"},
      {[](S s) {
         set_shape(s, PyramidShape{{glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}});
       },
       "/objects/0/vertices: expected 4 points that enclose a volume, got 4 points in a plane"},
      {[](S s) {
         set_shape(s, PyramidShape{{glm::dvec3(0), {1, 0, 0}, {0, 1, 0}, {0, 1, 0}}});
       },
       "/objects/0/vertices: expected 4 different points, got two that coincide"},
      {[](S s) {
         set_shape(s, BoxShape{{0, 0, 0}, {1, 0, 1}});
       },
       "/objects/0/max: expected every component above that of min [0, 0, 0], got [1, 0, 1]"},
      {[](S s) { set_shape(s, MeshShape{}); },
       "/objects/0/mesh: expected the index of a mesh, got -1"},
      {[](S s) { set_shape(s, MeshShape{1}); },
       "/objects/0/mesh: expected the index of a mesh, got 1"},
  });
}

TEST(Validate, Objects) {
  using S = Scene&;
  expect_errors({
      {[](S s) {
         s.objects[0].transform.axis = {0, 0, 0};
       },
       "/objects/0/transform/rotation/axis: expected a vector that is not zero, got [0, 0, 0]"},
      {[](S s) { s.objects[0].transform.degrees = kNan; },
       "/objects/0/transform/rotation/degrees: expected a number from -1000000 to 1000000, got "
       "nan"},
      {[](S s) { s.objects[0].transform.scale.y = 0; },
       "/objects/0/transform/scale: expected factors from 1e-12 to 1e+12, either sign, got [1, 0, "
       "1]"},
      {[](S s) { s.objects[0].transform.translation.y = kNan; },
       "/objects/0/transform/translation: expected finite components of at most 1e+18, got [0, "
       "nan, 0]"},
      {[](S s) { s.objects[0].material = 1; },
       "/objects/0/material: expected -1 or an index below 1, got 1"},
      {[](S s) { s.objects[0].medium = 7; },
       "/objects/0/medium: expected -1 or an index below 1, got 7"},
      {[](S s) {
         s.objects.resize(2);
         s.objects[0].name = s.objects[1].name = "a";
       },
       "/objects/1/name: expected a name of its own, got \"a\" for a second time"},
  });
}

TEST(Validate, MediaNeedClosedShapes) {
  const Shape open[] = {DiscShape{}, RectangleShape{}, TriangleShape{}};
  const Shape closed[] = {SphereShape{}, CylinderShape{}, PyramidShape{}, BoxShape{}, MeshShape{0}};
  Scene scene = good_scene();
  scene.objects[0].medium = 0;
  for (const Shape& shape : open) {
    scene.objects[0].shape = shape;
    EXPECT_EQ(
        error_of(scene),
        "/objects/0/medium: expected a closed shape (sphere, cylinder, pyramid, box or mesh), "
        "got an open one");
  }
  for (const Shape& shape : closed) {
    scene.objects[0].shape = shape;
    EXPECT_EQ(error_of(scene), "no error");
  }
}

TEST(Validate, Meshes) {
  using S = Scene&;
  using M = Mesh&;
  expect_errors({
      {[](S s) { s.meshes[0].data.reset(); },
       "/meshes/0/file: expected a mesh file, or positions and triangles, got none"},
      {[](S s) { set_mesh(s, [](M m) { m.triangles.clear(); }); },
       "/meshes/0/triangles: expected at least one triangle, got an empty mesh"},
      {[](S s) { set_mesh(s, [](M m) { m.positions[1].y = kNan; }); },
       "/meshes/0/positions: expected finite components of at most 1e+18, got [1, nan, 0] (element "
       "1)"},
      {[](S s) { set_mesh(s, [](M m) { m.triangles[0][2] = 3; }); },
       "/meshes/0/triangles: expected indices below 3, got 3 (element 0)"},
      {[](S s) { set_mesh(s, [](M m) {
                   m.normals = {{0, 0, 1}};
                 }); },
       "/meshes/0/normals: expected one per position (3), got 1"},
      {[](S s) { set_mesh(s, [](M m) {
                   m.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 2}};
                 }); },
       "/meshes/0/normals: expected vectors of length 1, got [0, 0, 2] (element 2)"},
      {[](S s) { set_mesh(s, [](M m) {
                   m.uvs = {{0, 0}};
                 }); },
       "/meshes/0/uvs: expected one per position (3), got 1"},
      {[](S s) { set_mesh(s, [](M m) {
                   m.uvs = {{0, 0}, {kNan, 1}, {0, 0}};
                 }); },
       "/meshes/0/uvs: expected finite components of at most 1e+18, got [nan, 1, 0] (element 1)"},
  });
}

}  // namespace
}  // namespace lightbench
