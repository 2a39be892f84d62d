// compile(): what each edit rebuilds, and that taking over the rest never changes the picture.

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "app/proof/measure.h"
#include "core/compile/parts.h"
#include "core/compile/render_scene.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

std::shared_ptr<const Mesh> tetrahedron(double size) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = {{0, size, 0}, {-size, 0, -size}, {size, 0, -size}, {0, 0, size}};
  mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

std::shared_ptr<const Texels> picture(float value) {
  return std::make_shared<Texels>(
      make_texels({2, 2, {value, 0, 0, 0, value, 0, 0, 0, value, value, value, value}}));
}

/// A little of everything.
Scene scene_with_everything() {
  Scene s;
  s.render.width = 20;
  s.render.height = 16;
  s.camera.look_from = {0, 2, 9};
  s.environment.color = glm::dvec3(0.3);
  s.textures.resize(2);
  s.textures[0].kind = TextureKind::Checker;
  s.textures[1].kind = TextureKind::Image;
  s.textures[1].image = picture(0.8F);
  s.materials.resize(5);
  s.materials[0].base_color_texture = 0;
  s.materials[1].kind = MaterialKind::Metal;
  s.materials[1].roughness = 0.4;
  s.materials[2].kind = MaterialKind::Dielectric;
  s.materials[3].kind = MaterialKind::Emissive;
  s.materials[3].emissive = glm::dvec3(4);
  s.materials[4].base_color_texture = 1;
  s.media.resize(1);
  s.media[0].density = 0.3;
  s.meshes = {{"pyramid", "", tetrahedron(1)}};
  const auto add = [&](Shape shape, glm::dvec3 place, int material, int medium = kNone) {
    Object o;
    o.shape = shape;
    o.transform.translation = place;
    o.material = material;
    o.medium = medium;
    s.objects.push_back(o);
  };
  add(RectangleShape{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}}, {0, 0, 0}, 0);
  add(SphereShape{{0, 0, 0}, 1, {0.3, 0, 0}}, {-2, 1, 0}, 1);
  add(SphereShape{}, {2, 1, 1}, 2);
  add(DiscShape{{0, 0, 0}, {0, -1, 0}, 1}, {0, 5, 0}, 3);
  add(MeshShape{0}, {0, 0.2, -1}, 4);
  add(BoxShape{}, {0, 1, 2}, kNone, 0);
  return s;
}

/// As compile() wants it: named and in range.
Scene valid(Scene s) {
  const auto name = [](auto& list) {
    for (std::size_t i = 0; i < list.size(); ++i) list[i].name = "n" + std::to_string(i);
  };
  name(s.textures);
  name(s.materials);
  name(s.media);
  name(s.meshes);
  validate(s);
  return s;
}

std::uint64_t film_hash(const RenderScene& scene) {
  return proof::render_film(scene, 2).hash() ^
         static_cast<std::uint64_t>(scene.film_unit * 1048576);
}

struct Edit {
  const char* what;
  Change rebuilt;
  std::function<void(Scene&)> apply;
};

constexpr Change kShading = Change::Materials;
constexpr Change kShapes = Change::Geometry | Change::Materials;

const std::vector<Edit>& edits() {
  using S = Scene&;
  static const std::vector<Edit> table{
      {"exposure", Change::None, [](S s) { s.display.exposure += 1; }},
      {"spp", Change::None, [](S s) { s.render.spp += 1; }},
      {"a name", Change::None, [](S s) { s.objects[0].name += "x"; }},
      {"depth", Change::None, [](S s) { s.render.max_depth = s.render.max_depth == 3 ? 9 : 3; }},
      {"strategy", Change::None,
       [](S s) {
         s.render.strategy =
             s.render.strategy == Strategy::Lights ? Strategy::Bsdf : Strategy::Lights;
       }},
      {"sampler", Change::None,
       [](S s) {
         s.render.sampler =
             s.render.sampler == SamplerKind::Sobol ? SamplerKind::Independent : SamplerKind::Sobol;
       }},
      {"seed", Change::None, [](S s) { s.render.seed += 7; }},
      {"filter", Change::None,
       [](S s) {
         s.render.filter = FilterKind::Gaussian;
         s.render.filter_radius += 0.5;
       }},
      {"resolution", Change::None, [](S s) { s.render.width = s.render.width == 20 ? 23 : 20; }},
      {"crop", Change::None,
       [](S s) {
         s.render.crop = s.render.crop.width == 0 ? Crop{3, 2, 11, 9} : Crop{};
       }},
      {"camera", Change::None, [](S s) { s.camera.look_from.x += 0.25; }},
      {"lens", Change::None, [](S s) { s.camera.lens_radius += 0.1; }},
      {"shutter", kShapes,
       [](S s) { s.camera.shutter_close = s.camera.shutter_close > 0.6 ? 0.5 : 1; }},
      {"environment", Change::None, [](S s) { s.environment.strength += 0.5; }},
      {"environment image", Change::None,
       [](S s) {
         s.environment.kind = EnvironmentKind::Image;
         s.environment.image = picture(2);
       }},
      {"a colour", kShading, [](S s) { s.materials[0].base_color.x *= 0.9; }},
      {"a kind of material", kShading,
       [](S s) {
         s.materials[1].kind = s.materials[1].kind == MaterialKind::Metal ? MaterialKind::Lambertian
                                                                          : MaterialKind::Metal;
       }},
      {"a light's strength", kShading, [](S s) { s.materials[3].emissive *= 1.5; }},
      {"a glow", kShading, [](S s) { s.materials[4].emissive.y += 1; }},
      {"a medium", kShading, [](S s) { s.media[0].density *= 1.5; }},
      {"which material", kShading,
       [](S s) { s.objects[1].material = (s.objects[1].material + 1) % 5; }},
      {"a texture", Change::Textures, [](S s) { s.textures[0].scale += 1; }},
      {"a texture's image", Change::Textures, [](S s) { s.textures[1].image = picture(0.5F); }},
      {"a texture more", Change::Textures | kShading,
       [](S s) {
         s.textures.emplace_back();
         s.materials[0].base_color_texture = static_cast<int>(s.textures.size()) - 1;
       }},
      {"a transform", kShapes,
       [](S s) {
         s.objects[2].transform.degrees += 10;
         s.objects[2].transform.translation.y += 0.1;
       }},
      {"a mesh's transform", kShapes, [](S s) { s.objects[4].transform.degrees += 15; }},
      {"a shape", kShapes,
       [](S s) {
         s.objects[3].shape = DiscShape{{0, 0, 0}, {0.1, -1, 0}, 1.3};
       }},
      {"visibility", kShapes, [](S s) { s.objects[2].visible = !s.objects[2].visible; }},
      {"an object more", kShapes,
       [](S s) {
         s.objects.push_back(s.objects[1]);
         s.objects.back().transform.translation.z -= 0.3 * static_cast<double>(s.objects.size());
       }},
      {"a mesh", kShapes, [](S s) { s.meshes[0].data = tetrahedron(1.25); }},
      {"a medium for a surface", kShapes,
       [](S s) { s.objects[2].medium = s.objects[2].medium == 0 ? kNone : 0; }},
      {"a material for a boundary", kShapes,
       [](S s) { s.objects[5].material = s.objects[5].material == 2 ? kNone : 2; }},
  };
  return table;
}

TEST(Compile, RebuildsOnlyWhatAnEditTouches) {
  const Scene before = scene_with_everything();
  const auto compiled = compile(before, KernelKind::Scalar);
  EXPECT_EQ(compiled->stats.rebuilt, Change::Geometry | Change::Materials | Change::Textures);
  for (const Edit& edit : edits()) {
    Scene after = before;
    edit.apply(after);
    (void)valid(after);
    const Change change = diff(before, after);
    const auto next = compile(after, KernelKind::Scalar, compiled.get(), change);
    EXPECT_EQ(next->stats.rebuilt, edit.rebuilt) << edit.what;
    EXPECT_EQ(film_hash(*next), film_hash(*compile(after, KernelKind::Scalar))) << edit.what;
    if (resets_film(change)) {
      EXPECT_NE(film_hash(*next), film_hash(*compiled)) << edit.what << ": had no effect";
    } else {
      EXPECT_EQ(film_hash(*next), film_hash(*compiled)) << edit.what;
    }
  }
}

TEST(Compile, AfterAnyEditsIsAsIfAnew) {
  for (const KernelKind kernel : {KernelKind::Auto, KernelKind::Reference}) {
    std::mt19937 engine(11);
    Scene scene = scene_with_everything();
    auto compiled = compile(scene, kernel);
    std::string history;
    for (int step = 0; step < 60; ++step) {
      Scene after = scene;
      for (auto n = 1 + engine() % 3; n > 0; --n) {
        const Edit& edit = edits()[engine() % edits().size()];
        history += std::string(edit.what) + "; ";
        edit.apply(after);
      }
      (void)valid(after);
      compiled = compile(after, kernel, compiled.get(), diff(scene, after));
      scene = after;
      ASSERT_EQ(film_hash(*compiled), film_hash(*compile(scene, kernel)))
          << kernel_name(kernel) << " after " << history;
    }
  }
}

const GeometryPart<float>& geometry_of(const RenderScene& scene) {
  return *std::get<KernelParts<float>>(scene.parts->kernel).geometry;
}

/// Balls in the view of the default camera.
Scene many_balls() {
  std::mt19937 engine(12);
  std::uniform_real_distribution<double> place(-2, 2);
  Scene s;
  s.render.width = 32;
  s.render.height = 18;
  s.environment.color = glm::dvec3(0.5);
  s.materials.resize(1);
  s.objects.resize(10'000);
  for (Object& o : s.objects) {
    o.shape = SphereShape{{0, 0, 0}, 0.03};
    o.transform.translation = {place(engine), place(engine), place(engine)};
    o.material = 0;
  }
  return valid(s);
}

TEST(Compile, FitsTheTreeOfManySurfacesToAMove) {
  Scene scene = many_balls();
  auto compiled = compile(scene, KernelKind::Scalar);
  const std::vector<std::uint32_t> order = geometry_of(*compiled).tree.items;
  const float cost = geometry_of(*compiled).built_cost;
  for (int step = 0; step < 3; ++step) {
    Scene after = scene;
    after.objects[5000].transform.translation.x += 0.2;
    compiled = compile(after, KernelKind::Scalar, compiled.get(), diff(scene, after));
    scene = after;
    EXPECT_EQ(geometry_of(*compiled).tree.items, order);
    EXPECT_EQ(geometry_of(*compiled).built_cost, cost);
    const auto anew = compile(scene, KernelKind::Scalar);
    EXPECT_NE(geometry_of(*anew).built_cost, cost);
    EXPECT_EQ(film_hash(*compiled), film_hash(*anew));
  }
}

TEST(Compile, BuildsATreeAnewThatEditsHaveSpoiled) {
  const Scene scene = many_balls();
  const auto compiled = compile(scene, KernelKind::Scalar);
  Scene after = scene;
  // Neighbours part.
  for (std::size_t i = 0; i < after.objects.size(); i += 2)
    after.objects[i].transform.translation *= -1.0;
  const auto next = compile(after, KernelKind::Scalar, compiled.get(), diff(scene, after));
  const auto anew = compile(after, KernelKind::Scalar);
  EXPECT_EQ(geometry_of(*next).tree.items, geometry_of(*anew).tree.items);
  EXPECT_NE(geometry_of(*next).tree.items, geometry_of(*compiled).tree.items);
  EXPECT_EQ(film_hash(*next), film_hash(*anew));
}

TEST(Compile, AnotherKernelTakesNothingOver) {
  const Scene scene = scene_with_everything();
  const auto scalar = compile(scene, KernelKind::Scalar);
  const auto reference = compile(scene, KernelKind::Reference, scalar.get(), Change::None);
  EXPECT_EQ(film_hash(*reference), film_hash(*compile(scene, KernelKind::Reference)));
}

bool used(const RenderScene& scene, const std::string& feature) {
  for (const FeatureUse& f : scene.stats.features) {
    if (f.name == feature) return f.used;
  }
  ADD_FAILURE() << "no feature called " << feature;
  return false;
}

TEST(Compile, SaysWhichFeaturesASceneUses) {
  Scene plain;
  plain.render.width = plain.render.height = 8;
  plain.materials.resize(1);
  Object ball;
  ball.material = 0;
  plain.objects = {ball};
  struct Case {
    const char* feature;
    std::function<void(Scene&)> add;
  };
  using S = Scene&;
  const auto metal = [](double fuzz, double roughness) {
    return [=](S s) {
      s.materials[0].kind = MaterialKind::Metal;
      s.materials[0].fuzz = fuzz;
      s.materials[0].roughness = roughness;
    };
  };
  const auto textured = [](TextureKind kind) {
    return [=](S s) {
      s.textures.resize(1);
      s.textures[0].kind = kind;
      s.textures[0].image = picture(1);
      s.materials[0].base_color_texture = 0;
    };
  };
  const auto lit = [](MaterialKind kind, const Shape& shape) {
    return [=](S s) {
      s.materials.resize(2);
      s.materials[0].emissive = glm::dvec3(1);
      s.materials[1].kind = kind;
      Object beside;
      beside.shape = shape;
      beside.material = 1;
      s.objects.push_back(beside);
    };
  };
  const std::vector<Case> cases{
      {"bvh", [](S s) { s.objects.resize(100, s.objects[0]); }},
      {"walls", [](S s) { s.objects[0].shape = RectangleShape{}; }},
      {"motion",
       [](S s) {
         s.objects[0].shape = SphereShape{{0, 0, 0}, 1, {1, 0, 0}};
       }},
      {"triangles", [](S s) { s.objects[0].shape = TriangleShape{}; }},
      {"meshes",
       [](S s) {
         s.meshes.push_back({"mesh", "", tetrahedron(1)});
         s.objects[0].shape = MeshShape{0};
       }},
      {"ellipsoids",
       [](S s) {
         s.objects[0].transform.scale = {1, 2, 1};
       }},
      {"emission", [](S s) { s.materials[0].emissive = glm::dvec3(1); }},
      {"lens", [](S s) { s.camera.lens_radius = 0.1; }},
      {"lights", [](S s) { s.materials[0].emissive = glm::dvec3(1); }},
      {"choice of lights",
       [](S s) {
         s.materials[0].emissive = glm::dvec3(1);
         s.objects.resize(2, s.objects[0]);
       }},
      {"light tree",
       [](S s) {
         s.materials[0].emissive = glm::dvec3(1);
         s.objects.resize(kMaxLightCandidates + 1, s.objects[0]);
       }},
      {"images in mirrors",
       lit(MaterialKind::Metal, RectangleShape{{-1, -2, -1}, {2, 0, 0}, {0, 0, 2}})},
      {"images in panes",
       [=](S s) {
         lit(MaterialKind::Dielectric, BoxShape{{-1, 9, -1}, {1, 10, 1}})(s);
         s.objects.resize(3, s.objects[0]);
         s.objects[2].transform.translation.y = 20;
       }},
      {"images in glass", lit(MaterialKind::Dielectric, SphereShape{{0, 0, 20}, 1, {0, 0, 0}})},
      {"environment", [](S s) { s.environment.color = glm::dvec3(1); }},
      {"media",
       [](S s) {
         s.media.resize(1);
         s.objects[0].medium = 0;
       }},
      {"textures", textured(TextureKind::Constant)},
      {"emission textures",
       [](S s) {
         s.textures.resize(1);
         s.materials[0].emissive = glm::dvec3(1);
         s.materials[0].emissive_texture = 0;
       }},
      {"refined hits",
       [](S s) {
         s.camera.look_from = {0, 0, 1e3};
       }},
      {"uv", textured(TextureKind::Image)},
      {"solid textures", textured(TextureKind::Marble)},
      {"mirror", metal(0, 0)},
      {"fuzz", metal(0.2, 0)},
      {"ggx", metal(0, 0.2)},
      {"dielectric", [](S s) { s.materials[0].kind = MaterialKind::Dielectric; }},
  };
  const auto without = compile(plain, KernelKind::Auto);
  EXPECT_TRUE(used(*without, "lambertian"));
  EXPECT_EQ(without->stats.features.size(), cases.size() + 1) << "a feature has no case here";
  for (const Case& c : cases) {
    EXPECT_FALSE(used(*without, c.feature)) << c.feature;
    Scene with = plain;
    c.add(with);
    (void)valid(with);
    const auto compiled = compile(with, KernelKind::Auto);
    EXPECT_TRUE(used(*compiled, c.feature)) << c.feature;
    // Hidden or unassigned, it is not used.
    with.objects[0].visible = false;
    const std::string feature = c.feature;
    if (feature == "lens" || feature == "environment" || feature == "bvh") continue;
    EXPECT_FALSE(used(*compile(with, KernelKind::Auto), c.feature))
        << c.feature << " of a hidden object";
  }
}

TEST(Compile, LightsAreChosenAsTheSceneAsks) {
  Scene scene = load_scene(LIGHTBENCH_SOURCE_DIR "/scenes/cornell-three-lights.json");
  scene.render.width = scene.render.height = 16;
  const auto film_by = [&](LightChoiceBy choice) {
    scene.render.light_choice = choice;
    const auto compiled = compile(scene, KernelKind::Auto);
    EXPECT_EQ(used(*compiled, "choice of lights"), choice != LightChoiceBy::Power);
    EXPECT_EQ(used(*compiled, "images in mirrors"), choice == LightChoiceBy::Images);
    return film_hash(*compiled);
  };
  const auto images = film_by(LightChoiceBy::Images),
             contribution = film_by(LightChoiceBy::Contribution),
             power = film_by(LightChoiceBy::Power);
  EXPECT_NE(images, contribution);
  EXPECT_NE(contribution, power);
}

// Judging each of very many lights at every vertex would cost more than it gains.
TEST(Compile, ManyLightsAreChosenByATree) {
  Scene many = load_scene(LIGHTBENCH_SOURCE_DIR "/scenes/features/many-lights.json");
  const auto tree = compile(many, KernelKind::Auto);
  EXPECT_FALSE(used(*tree, "choice of lights"));
  EXPECT_TRUE(used(*tree, "light tree"));
  many.render.light_choice = LightChoiceBy::Power;
  EXPECT_FALSE(used(*compile(many, KernelKind::Auto), "light tree"));
}

TEST(Compile, WithBsdfSamplingAloneLightsAreNotSampled) {
  Scene scene = scene_with_everything();
  EXPECT_TRUE(used(*compile(scene, KernelKind::Auto), "lights"));
  scene.render.strategy = Strategy::Bsdf;
  const auto compiled = compile(scene, KernelKind::Auto);
  EXPECT_FALSE(used(*compiled, "lights"));
  Film film(compiled->crop.width, compiled->crop.height, compiled->film_unit);
  Counters counters;
  render(*compiled, {0, 0, film.width(), film.height(), 0, 2, 1}, film.view(), counters);
  EXPECT_EQ(counters.shadow_rays, 0U);
  EXPECT_EQ(compiled->stats.lights, 1) << "they are still there";
}

TEST(Compile, WhatASceneDoesNotUseChangesNoBit) {
  const Scene plain = scene_with_everything();
  const std::uint64_t expected = film_hash(*compile(plain, KernelKind::Auto));
  Scene more = plain;
  Texture marble;
  marble.kind = TextureKind::Marble;
  more.textures.push_back(marble);
  for (const MaterialKind kind :
       {MaterialKind::Metal, MaterialKind::Dielectric, MaterialKind::Lambertian}) {
    Material m;
    m.kind = kind;
    m.fuzz = 0.5;
    m.base_color_texture = static_cast<int>(more.textures.size()) - 1;
    more.materials.push_back(m);
  }
  more.media.emplace_back();
  more.meshes.push_back({"unused", "", tetrahedron(3)});
  Object hidden = plain.objects[3];
  hidden.visible = false;
  more.objects.push_back(hidden);
  EXPECT_EQ(film_hash(*compile(more, KernelKind::Auto)), expected);
  // A bright material that nothing wears: it may not even change the film's unit.
  more.materials.push_back(plain.materials[3]);
  more.materials.back().emissive = glm::dvec3(1e4);
  EXPECT_EQ(compile(more, KernelKind::Auto)->film_unit,
            compile(plain, KernelKind::Auto)->film_unit);
}

TEST(Compile, MovedOrScaledWorldsRenderAlike) {
  // Render space: the whole scene times a power of two, or moved by as much, is the same to the
  // last bit.
  const auto world = [](double scale, const glm::dvec3& shift) {
    Scene s = scene_with_everything();
    s.objects.pop_back();  // a medium's density would have to scale too
    s.objects[0].shape =
        RectangleShape{scale * glm::dvec3(-9, 0, -9), {0, 0, 18 * scale}, {18 * scale, 0, 0}};
    s.objects[1].shape = SphereShape{{0, 0, 0}, scale, {0.25 * scale, 0, 0}};
    s.objects[2].shape = SphereShape{{0, 0, 0}, scale};
    s.objects[3].shape = DiscShape{{0, 0, 0}, {0, -1, 0}, scale};
    s.meshes[0].data = tetrahedron(scale);
    s.materials[0].base_color_texture = kNone;  // checkers live in object space
    for (Object& o : s.objects) o.transform.translation = scale * o.transform.translation + shift;
    s.objects[4].transform.translation.y = shift.y + 0.25 * scale;
    s.camera.look_from = scale * s.camera.look_from + shift;
    s.camera.look_at = scale * s.camera.look_at + shift;
    s.camera.focus_distance *= scale;
    return film_hash(*compile(s, KernelKind::Auto));
  };
  const std::uint64_t expected = world(1, {0, 0, 0});
  EXPECT_EQ(world(1024, {0, 0, 0}), expected);
  EXPECT_EQ(world(1.0 / 4096, {0, 0, 0}), expected);
  EXPECT_EQ(world(1, {64, -128, 4096}), expected);
  // Float rounds the same numbers alike in any units (see unit_scale).
  EXPECT_EQ(world(1e-4, {0, 0, 0}), expected);
  EXPECT_EQ(world(25.4, {0, 0, 0}), expected);
}

TEST(Compile, CountsWhatItHolds) {
  const Scene scene = scene_with_everything();
  const RenderStats s = compile(scene, KernelKind::Auto)->stats;
  EXPECT_EQ(s.objects, 6);
  EXPECT_EQ(s.triangles, 4);
  EXPECT_EQ(s.primitives, 5 + 4);
  EXPECT_EQ(s.lights, 1);
  EXPECT_GT(s.bytes, 0);
}

TEST(Compile, TakesScenesWithHardlyAnythingInThem) {
  Scene scene;
  scene.render.width = scene.render.height = 4;
  scene.environment.color = glm::dvec3(0.5);
  const auto check = [&](const char* what) {
    for (const KernelKind kernel : {KernelKind::Scalar, KernelKind::Auto, KernelKind::Reference}) {
      const auto compiled = compile(scene, kernel);
      Film film(4, 4, compiled->film_unit);
      Counters counters;
      render(*compiled, {0, 0, 4, 4, 0, 8, 1}, film.view(), counters);
      EXPECT_EQ(counters.non_finite, 0U) << what;
      for (const float x : film.mean(8).rgb) EXPECT_FLOAT_EQ(x, 0.5F) << what;
    }
  };
  check("nothing");
  scene.materials.resize(1);
  check("a material only");
  // White fog in white light is invisible; depth enough that no path is cut.
  scene.media.resize(1);
  scene.materials.clear();
  scene.objects.resize(1);
  scene.objects[0].medium = 0;
  scene.render.max_depth = 1000;
  scene.render.roulette_depth = 1000;
  check("fog without any material");
  scene.objects[0].visible = false;
  check("a hidden object");
}

}  // namespace
}  // namespace lightbench
