// What is saved is what was there: every field, every bit.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "core/film/image_file.h"
#include "core/scene/scene_io.h"
#include "tests/unit/temporary_folder.h"

namespace lightbench {
namespace {

const double kThird = 1.0 / 3.0;  // no short decimal

/// Every field differs from its default.
Scene full_scene(const TemporaryFolder& folder) {
  Scene s;
  s.camera.look_from = {0.1, -0.0, 1e-17};
  s.camera.look_at = {1e17, kThird, -2.5};
  s.camera.up = {0, std::nextafter(1.0, 2.0), 1};
  s.camera.vfov = 100 * kThird;
  s.camera.sensor_height = 35.9;
  s.camera.lens_radius = 0.1;
  s.camera.focus_distance = std::numeric_limits<double>::epsilon();
  s.camera.shutter_open = -0.25;
  s.camera.shutter_close = 0.75;
  s.render.width = 320;
  s.render.height = 180;
  s.render.crop = {1, 2, 30, 40};
  s.render.spp = 12345;
  s.render.time_limit = 90.5;
  s.render.max_depth = 7;
  s.render.roulette_depth = 3;
  s.render.strategy = Strategy::Lights;
  s.render.light_choice = LightChoiceBy::Contribution;
  s.render.sampler = SamplerKind::Independent;
  s.render.seed = 4294967295U;
  s.render.adaptive = true;
  s.render.filter = FilterKind::Gaussian;
  s.render.filter_radius = 1.5;
  s.render.snapshots = {};
  s.display.exposure = -kThird;
  s.display.tone_map = ToneMap::Aces;
  s.environment.kind = EnvironmentKind::Image;
  s.environment.color = {0.5, 0.25, kThird};
  s.environment.horizon = {0, 0.1, 0.2};
  s.environment.strength = 3;
  s.environment.rotation = -77.7;
  s.environment.file = (folder / "sky.pfm").string();

  Texture texture;
  texture.name = "a \"quoted\" \\ name / \xc3\xa9";
  texture.kind = TextureKind::Image;
  texture.color_a = {0.1, 0.2, 0.3};
  texture.color_b = {0.4, 0.5, 0.6};
  texture.scale = 1e-5;
  texture.use_uv = true;
  texture.octaves = 3;
  texture.seed = 99;
  texture.wrap = WrapMode::Mirror;
  texture.file = (folder / "map.ppm").string();
  texture.srgb = false;
  s.textures = {texture, texture};
  s.textures[1].name = "other";
  s.textures[1].kind = TextureKind::Marble;

  Material material;
  material.name = "m0";
  material.kind = MaterialKind::Metal;
  material.base_color = {0.1, 1, 0};
  material.base_color_texture = 1;
  material.fuzz = 0.3;
  material.ior = 2.4;
  material.emissive = {1, 2, 3};
  material.emissive_strength = 4.5;
  material.emissive_texture = 0;
  material.two_sided = true;
  s.materials = {material, material};
  s.materials[1].name = "m1";
  s.materials[1].kind = MaterialKind::Dielectric;
  s.materials[1].fuzz = 0;
  s.materials[1].roughness = kThird;

  s.media.emplace_back();
  s.media[0] = {"fog", 0.01, {0.9, 0.8, 0.7}};

  s.meshes.resize(2);
  s.meshes[0].name = "inline";
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {kThird, 0, 0}, {0, 0.1, 0}, {-0.0, 1e-300, 3}};
  mesh.normals.assign(4, glm::dvec3(0.6, 0.8, 0));
  mesh.uvs = {{0, 0}, {1, 0}, {0, 1}, {kThird, kThird}};
  mesh.triangles = {{0, 1, 2}, {3, 2, 1}};
  s.meshes[0].data = std::make_shared<const Mesh>(mesh);
  s.meshes[1].name = "from file";
  s.meshes[1].file = (folder / "tri.ply").string();

  const Shape shapes[] = {SphereShape{{1, 2, 3}, 4, {5, 6, 7}},
                          CylinderShape{{1, 2, 3}, {4, 5, 6}, 7},
                          DiscShape{{1, 2, 3}, {4, 5, 6}, 7},
                          RectangleShape{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}},
                          TriangleShape{{1, 2, 3}, {4, 5, 6}, {7, 8, 10}},
                          PyramidShape{{glm::dvec3(0), {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}},
                          BoxShape{{1, 2, 3}, {4, 5, 6}},
                          MeshShape{0},
                          MeshShape{1}};
  for (const Shape& shape : shapes) {
    Object object;
    object.shape = shape;
    s.objects.push_back(object);
  }
  Object& object = s.objects[0];
  object.name = "ball";
  object.transform = {{1, 2, 3}, {0, 0, 2}, 45 * kThird, {1, -2, 3}};
  object.material = 1;
  object.medium = 0;
  object.visible = false;
  s.objects[1].transform.scale = glm::dvec3(kThird);
  return s;
}

/// A folder with the files that full_scene names, and the scene with its payloads loaded.
struct Fixture {
  TemporaryFolder folder;
  Scene scene;

  Fixture() {
    write_image(folder / "sky.pfm", {2, 1, {1, 2, 3, 4, 5, 6}}, {});
    folder.write("map.ppm", std::string("P6 1 1 255\n\x10\x20\x30", 14));
    folder.write("tri.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    scene = full_scene(folder);
    scene.environment.image = load_image(scene.environment.file, true);
    for (Texture& texture : scene.textures) texture.image = load_image(texture.file, texture.srgb);
    scene.meshes[1].data = load_mesh(scene.meshes[1].file);
  }
};

bool same_bits(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }

/// Compares payloads by value, then everything else with ==.
void expect_equal(const Scene& expected, Scene actual) {
  ASSERT_EQ(actual.meshes.size(), expected.meshes.size());
  for (std::size_t i = 0; i < actual.meshes.size(); ++i) {
    EXPECT_EQ(*actual.meshes[i].data, *expected.meshes[i].data);
    actual.meshes[i].data = expected.meshes[i].data;
  }
  const auto same_image = [](std::shared_ptr<const Texels>& image,
                             const std::shared_ptr<const Texels>& wanted) {
    ASSERT_EQ(image == nullptr, wanted == nullptr);
    if (image != nullptr) {
      EXPECT_EQ(*image, *wanted);
    }
    image = wanted;
  };
  same_image(actual.environment.image, expected.environment.image);
  ASSERT_EQ(actual.textures.size(), expected.textures.size());
  for (std::size_t i = 0; i < actual.textures.size(); ++i)
    same_image(actual.textures[i].image, expected.textures[i].image);
  EXPECT_EQ(actual.camera, expected.camera);
  EXPECT_EQ(actual.render, expected.render);
  EXPECT_EQ(actual.display, expected.display);
  EXPECT_EQ(actual.environment, expected.environment);
  EXPECT_EQ(actual.textures, expected.textures);
  EXPECT_EQ(actual.materials, expected.materials);
  EXPECT_EQ(actual.media, expected.media);
  EXPECT_EQ(actual.meshes, expected.meshes);
  EXPECT_EQ(actual.objects, expected.objects);
  EXPECT_EQ(actual, expected);
}

TEST(SceneRoundTrip, EveryFieldSurvives) {
  const Fixture fixture;
  const auto file = fixture.folder / "saved.json";
  save_scene(fixture.scene, file);
  const Scene loaded = load_scene(file);
  expect_equal(fixture.scene, loaded);
  EXPECT_TRUE(same_bits(loaded.camera.look_from.y, -0.0));
  EXPECT_TRUE(same_bits(loaded.meshes[0].data->positions[3].x, -0.0));
}

TEST(SceneRoundTrip, TheTextIsAFixedPoint) {
  const Fixture fixture;
  const std::string once = scene_to_json(fixture.scene, fixture.folder.path());
  const std::string twice =
      scene_to_json(parse_scene(once, fixture.folder.path(), "once"), fixture.folder.path());
  EXPECT_EQ(once, twice);
}

TEST(SceneRoundTrip, SavingElsewhereStillFindsTheFiles) {
  const Fixture fixture;
  std::filesystem::create_directories(fixture.folder / "deep/er");
  const auto file = fixture.folder / "deep/er/saved.json";
  save_scene(fixture.scene, file);
  expect_equal(fixture.scene, load_scene(file));
  const std::string text = scene_to_json(fixture.scene, fixture.folder / "deep/er");
  EXPECT_NE(text.find("\"../../map.ppm\""), std::string::npos) << text;
}

TEST(SceneRoundTrip, ABareNameIsInTheCurrentFolder) {
  const Fixture fixture;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(fixture.folder.path());
  save_scene(fixture.scene, "bare.json");
  const Scene loaded = load_scene("bare.json");
  std::filesystem::current_path(before);
  expect_equal(fixture.scene, loaded);
}

TEST(SceneRoundTrip, DefaultsAreLeftOut) {
  EXPECT_EQ(scene_to_json(Scene{}, "."), "{\"lightbench\": 1}\n");
  expect_equal(Scene{}, parse_scene(scene_to_json(Scene{}, "."), ".", "empty"));
}

TEST(SceneRoundTrip, DefaultShapesSurvive) {
  const Shape shapes[] = {SphereShape{},   CylinderShape{}, DiscShape{}, RectangleShape{},
                          TriangleShape{}, PyramidShape{},  BoxShape{}};
  Scene scene;
  for (const Shape& shape : shapes) scene.objects.emplace_back().shape = shape;
  expect_equal(scene, parse_scene(scene_to_json(scene, "."), ".", "shapes"));
}

TEST(SceneRoundTrip, EverySceneInTheRepository) {
  int count = 0;
  const std::filesystem::path root(LIGHTBENCH_SOURCE_DIR "/scenes");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".json") continue;
    const Scene scene = load_scene(entry.path());
    const auto folder = entry.path().parent_path();
    expect_equal(scene, parse_scene(scene_to_json(scene, folder), folder, "again"));
    ++count;
  }
  EXPECT_GE(count, 12);
}

TEST(SceneFiles, TheExampleInTheManualLoads) {
  std::ifstream manual(LIGHTBENCH_SOURCE_DIR "/docs/scene-format.md");
  const std::string text{std::istreambuf_iterator<char>(manual), {}};
  const std::string fence = "```json\n";
  const std::size_t begin = text.find(fence) + fence.size();
  const Scene scene =
      parse_scene(text.substr(begin, text.find("```", begin) - begin), ".", "manual");
  EXPECT_EQ(scene.objects.size(), 3U);
  EXPECT_EQ(scene.materials[0].base_color_texture, 0);
}

TEST(SceneFiles, OneFileIsLoadedOnce) {
  const Fixture fixture;
  const std::string text = R"({"lightbench": 1,
    "textures": [{"name": "a", "type": "image", "file": "map.ppm"},
                 {"name": "b", "type": "image", "file": "./x/../map.ppm"},
                 {"name": "c", "type": "image", "file": "map.ppm", "srgb": false}],
    "meshes": [{"name": "a", "file": "tri.ply"}, {"name": "b", "file": "tri.ply"}]})";
  const Scene scene = parse_scene(text, fixture.folder.path(), "shared");
  EXPECT_EQ(scene.textures[0].image, scene.textures[1].image);
  EXPECT_NE(scene.textures[0].image, scene.textures[2].image);
  EXPECT_EQ(scene.meshes[0].data, scene.meshes[1].data);
}

TEST(SceneFiles, OtherSpellingsOfTheSameThing) {
  const Scene scene = parse_scene(R"({"lightbench": 1.0,
    "camera": {"focalLength": 50, "sensorHeight": 36, "fStop": 2},
    "render": {"spp": 1e3, "resolution": [20.0, 10]},
    "objects": [{"type": "box", "transform": {"rotation": [0, 0, 0.70710678118654757,
                                                           0.70710678118654757], "scale": 2}},
                {"type": "box", "transform": {"rotation": [0, 0, 0, 1]}},
                {"type": "box", "transform": {"rotation": [0, 0, 3, -3], "scale": [1, 2, 3]}}]})",
                                  ".", "spellings");
  EXPECT_NEAR(focal_length(scene.camera), 50, 1e-12);
  EXPECT_NEAR(f_stop(scene.camera), 2, 1e-12);
  EXPECT_NEAR(scene.camera.lens_radius, 0.0125, 1e-15);
  EXPECT_EQ(scene.render.spp, 1000);
  EXPECT_EQ(scene.render.width, 20);
  EXPECT_EQ(scene.objects[0].transform.axis, glm::dvec3(0, 0, 1));
  EXPECT_NEAR(scene.objects[0].transform.degrees, 90, 1e-12);
  EXPECT_EQ(scene.objects[0].transform.scale, glm::dvec3(2));
  EXPECT_EQ(scene.objects[1].transform, Transform{});
  EXPECT_NEAR(scene.objects[2].transform.degrees, 270, 1e-12);
  EXPECT_EQ(scene.objects[2].transform.scale, glm::dvec3(1, 2, 3));
}

TEST(SceneFiles, OverridesAreAppliedInOrder) {
  const std::string text = R"({"lightbench": 1,
    "materials": [{"name": "glass", "type": "dielectric"}],
    "objects": [{"name": "a/b", "type": "sphere"}]})";
  const Scene scene = parse_scene(text, ".", "overridden",
                                  {{"/render/spp", "20"},
                                   {"/render/filter/type", "gaussian"},
                                   {"/display/toneMap", "aces"},
                                   {"/materials/glass/ior", "1.3"},
                                   {"/materials/0/baseColor", "[1, 0.5, 0]"},
                                   {"/objects/a~1b/radius", "2"},
                                   {"/objects/0/center", "[0,0,0]"},
                                   {"/objects/0/center/1", "7"},
                                   {"/render/spp", "30"}});
  EXPECT_EQ(scene.render.spp, 30);
  EXPECT_EQ(scene.render.filter, FilterKind::Gaussian);
  EXPECT_EQ(scene.display.tone_map, ToneMap::Aces);
  EXPECT_EQ(scene.materials[0].ior, 1.3);
  EXPECT_EQ(scene.materials[0].base_color, glm::dvec3(1, 0.5, 0));
  EXPECT_EQ(std::get<SphereShape>(scene.objects[0].shape).radius, 2);
  EXPECT_EQ(std::get<SphereShape>(scene.objects[0].shape).center, glm::dvec3(0, 7, 0));
}

TEST(SceneFiles, SavingAnInvalidSceneWritesNothing) {
  const TemporaryFolder folder;
  const auto file = folder.write("old.json", "old");
  Scene scene;
  scene.camera.vfov = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(save_scene(scene, file), Error);
  EXPECT_EQ(std::filesystem::file_size(file), 3U);
  scene = Scene{};
  scene.objects.emplace_back().name = "\xff";  // not UTF-8
  try {
    save_scene(scene, file);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Output);
    EXPECT_NE(std::string(error.what()).find("UTF-8"), std::string::npos);
  }
  EXPECT_EQ(std::filesystem::file_size(file), 3U);
  EXPECT_EQ(folder.file_count(), 1U);
}

TEST(SceneFiles, UnwritablePlacesAreOneLineErrors) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "folder.json");
  for (const auto& file : {folder / "no/such/folder.json", folder / "folder.json",
                           std::filesystem::path("/dev/null")}) {
    try {
      save_scene(Scene{}, file);
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Output);
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ": cannot be written: "));
    }
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(SceneFiles, SavingThroughALinkKeepsTheLinkAndThePermissions) {
  const TemporaryFolder folder;
  const auto file = folder.write("real.json", "old");
  std::filesystem::permissions(
      file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink("real.json", folder / "link.json");
  save_scene(Scene{}, folder / "link.json");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.json"));
  EXPECT_EQ(load_scene(file), Scene{});
  EXPECT_EQ(std::filesystem::status(file).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(folder.file_count(), 2U);
}

}  // namespace
}  // namespace lightbench
