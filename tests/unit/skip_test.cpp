// What a scene does not use is not entered, and not entering it changes no bit: each skip is
// switched off, or the feature given something to do that has no effect, and the films compared.

#include <gtest/gtest.h>

#include <functional>

#include "app/proof/measure.h"
#include "core/compile/compile_geometry.h"
#include "core/compile/parts.h"
#include "core/compile/render_scene.h"
#include "tests/unit/small_scenes.h"

namespace lightbench {
namespace {

constexpr KernelKind kTested[] = {KernelKind::Auto, KernelKind::Scalar, KernelKind::Reference};

/// Objects of all shapes but meshes, as few as a tree is built from.
Scene crowd() {
  Scene scene;
  scene.render.width = 24;
  scene.render.height = 16;
  scene.camera.look_from = {0.3, 0.4, 9.1};
  scene.camera.focus_distance = 8;
  scene.environment.color = glm::dvec3(1);
  const MaterialKind kinds[] = {MaterialKind::Lambertian, MaterialKind::Metal,
                                MaterialKind::Dielectric};
  for (const MaterialKind kind : kinds) {
    scene.materials.emplace_back();
    scene.materials.back().name = "material " + std::to_string(scene.materials.size());
    scene.materials.back().kind = kind;
  }
  scene.materials[1].roughness = 0.4;
  const Shape shapes[] = {SphereShape{},   CylinderShape{}, DiscShape{}, RectangleShape{},
                          TriangleShape{}, PyramidShape{},  BoxShape{}};
  for (int i = 0; i < static_cast<int>(kTinyScene); ++i) {
    Object o;
    o.shape = shapes[i % 7];
    o.material = i % 3;
    o.transform.translation = {(i % 8 - 3.5) * 0.9, (i / 8 - 3.5) * 0.9, -(i * 37 % 11) * 0.3};
    o.transform.axis = {1, 2, 3};
    o.transform.degrees = 29.0 * i;
    o.transform.scale = glm::dvec3(i % 5 == 0 ? 0.25 : 0.4);
    scene.objects.push_back(o);
  }
  return scene;
}

std::vector<std::pair<std::string, Scene>> stored_scenes() {
  auto scenes = small_scenes(24, 16);
  scenes.emplace_back("metal and glass", crowd());
  scenes.back().second.materials[0].kind = MaterialKind::Metal;
  return scenes;
}

std::uint64_t film_hash(const RenderScene& scene) { return proof::render_film(scene, 3).hash(); }

/// A copy of a compiled scene whose view `change` has altered.
template <class Change>
RenderScene altered(const RenderScene& scene, Change change) {
  RenderScene copy = scene;
  auto parts = std::make_shared<RenderScene::Parts>(*scene.parts);
  std::visit([&](auto& kernel) { change(kernel); }, parts->kernel);
  copy.parts = std::move(parts);
  return copy;
}

/// A flag that the kernel asks before it enters a station.
struct Flag {
  const char* name;
  bool SceneView<float>::*in_float;
  bool SceneView<double>::*in_double;
  bool& of(SceneView<float>& view) const { return view.*in_float; }
  bool& of(SceneView<double>& view) const { return view.*in_double; }
};
#define FLAG(name) \
  Flag { #name, &SceneView < float> ::name, &SceneView < double> ::name }
const Flag kFlags[] = {
    FLAG(has_triangles), FLAG(has_lambertian),  FLAG(has_mirror),   FLAG(has_fuzz),
    FLAG(has_ggx),       FLAG(has_dielectric),  FLAG(has_textures), FLAG(has_emission_textures),
    FLAG(needs_uv),      FLAG(has_environment), FLAG(has_emission),
};
#undef FLAG

TEST(Skips, StationsEnteredForNothingChangeNoBit) {
  std::vector<int> forced(std::size(kFlags)), missed(std::size(kFlags));
  for (const auto& [name, scene] : stored_scenes()) {
    for (const KernelKind kernel : kTested) {
      const auto compiled = compile(scene, kernel);
      const std::uint64_t expected = film_hash(*compiled);
      for (std::size_t f = 0; f < std::size(kFlags); ++f) {
        bool used = false;
        const RenderScene other = altered(*compiled, [&](auto& parts) {
          bool& flag = kFlags[f].of(parts.view);
          used = flag;
          flag = !flag;
        });
        const std::uint64_t found = film_hash(other);
        if (used) {
          missed[f] += found != expected ? 1 : 0;
          continue;
        }
        ++forced[f];
        EXPECT_EQ(found, expected)
            << name << " with " << kFlags[f].name << " in " << kernel_name(kernel);
      }
    }
  }
  for (std::size_t f = 0; f < std::size(kFlags); ++f) {
    EXPECT_GT(forced[f], 0) << "no scene here skips " << kFlags[f].name;
    EXPECT_GT(missed[f], 0) << "no scene here shows that it needs " << kFlags[f].name;
  }
}

TEST(Skips, TimesAndPointsInObjectSpaceThatNobodyAsksForChangeNoBit) {
  for (const auto& [name, scene] : stored_scenes()) {
    for (const KernelKind kernel : kTested) {
      const auto compiled = compile(scene, kernel);
      const std::uint64_t expected = film_hash(*compiled);
      std::vector<BvhMotion> rest;
      const RenderScene timed = altered(*compiled, [&](auto& parts) {
        parts.view.camera.moving = true;
        if (parts.view.nodes == nullptr || parts.view.motion != nullptr) return;
        rest.resize(parts.geometry->tree.nodes.size(), BvhMotion{});
        parts.view.motion = rest.data();
      });
      EXPECT_EQ(film_hash(timed), expected) << name << " with times in " << kernel_name(kernel);
      std::vector<float> to_object;
      std::vector<double> to_object_double;
      const RenderScene placed = altered(*compiled, [&]<class T>(KernelParts<T>& parts) {
        if (parts.view.to_object != nullptr) return;
        auto* maps = [&] {
          if constexpr (std::is_same_v<T, float>) {
            return &to_object;
          } else {
            return &to_object_double;
          }
        }();
        maps->assign(12 * parts.geometry->kind.size(), T(2));
        parts.view.to_object = maps->data();
      });
      EXPECT_EQ(film_hash(placed), expected)
          << name << " with object points in " << kernel_name(kernel);
    }
  }
}

void expect_same(const Scene& a, const Scene& b, const char* what) {
  for (const KernelKind kernel : kTested) {
    const auto one = compile(a, kernel), other = compile(b, kernel);
    EXPECT_EQ(one->film_unit, other->film_unit) << what;
    EXPECT_EQ(film_hash(*one), film_hash(*other)) << what << " in " << kernel_name(kernel);
  }
}

TEST(Skips, TheTreeFindsWhatALoopOverAllObjectsFinds) {
  for (const KernelKind kernel : kTested) {
    const auto tree = compile(crowd(), kernel);
    const RenderScene loop = altered(*tree, [](auto& parts) {
      ASSERT_NE(parts.view.nodes, nullptr);
      parts.view.nodes = nullptr;
    });
    EXPECT_EQ(film_hash(loop), film_hash(*tree)) << kernel_name(kernel);
  }
}

TEST(Skips, ALensWithoutAWidthIsAPinhole) {
  Scene lens = crowd();
  lens.camera.lens_radius = 1e-18;  // beside the eye's coordinates it vanishes
  expect_same(crowd(), lens, "lens");
}

TEST(Skips, AMediumThatScattersNothingIsNone) {
  // Rays from the inside and the outside, light samples through it.
  Scene fog = crowd();
  fog.media.emplace_back();
  fog.media.back().density = 1e-17;
  for (const Shape& shape : {Shape(BoxShape{{-3, -3, -3}, {3, 3, 3}}),
                             Shape(SphereShape{{0, 0, 6}, 4, glm::dvec3(0)})}) {
    Object o;
    o.shape = shape;
    o.medium = 0;
    fog.objects.push_back(o);
  }
  expect_same(crowd(), fog, "medium");
}

TEST(Skips, ALightThatNothingSeesAddsNothing) {
  // In a closed box of its own, so that every shadow ray to it is blocked. (Without a light a
  // path's directions come from other numbers.)
  const auto boxed = [](double emission) {
    Scene scene = crowd();
    scene.materials.emplace_back();
    scene.materials.back().name = "lamp";
    scene.materials.back().kind = MaterialKind::Emissive;
    scene.materials.back().emissive = glm::dvec3(emission);
    Object box, lamp;
    box.shape = BoxShape{{-4, 4.5, -1}, {-3, 5.5, 0}};
    box.material = 0;
    lamp.shape = SphereShape{{-3.5, 5, -0.5}, 0.3, glm::dvec3(0)};
    lamp.material = 3;
    scene.objects.push_back(box);
    scene.objects.push_back(lamp);
    return scene;
  };
  const Scene dim = boxed(1e-6), lit = boxed(0.01);
  EXPECT_EQ(compile(boxed(0), KernelKind::Auto)->stats.lights, 0);
  EXPECT_EQ(compile(lit, KernelKind::Auto)->stats.lights, 1);
  expect_same(dim, lit, "light");
}

}  // namespace
}  // namespace lightbench
