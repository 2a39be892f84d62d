// Every panel edits the scene through its widgets, and the picture follows.

#include <gtest/gtest.h>
#include <imgui.h>

#include <glm/geometric.hpp>

#include "tests/ui/interface.h"
#include "ui/panels.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

int object_named(const Scene& scene, const char* name) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].name == name) return static_cast<int>(i);
  }
  return kNone;
}

/// A row of the properties panel. Combo boxes are not found by wildcard.
std::string properties_of(Interface& interface, const char* row) {
  const Selection selection = interface.bench().editor.selection;
  const char* kind = selection.kind == ItemKind::Object ? "Object" : "Material";
  return std::string("//Properties/") + kind + "/$$" + std::to_string(selection.index) + "/" + row;
}

/// Runs `steps`, then checks that the scene changed in a way that shows.
void expect_new_picture(Interface& interface, const std::function<void(ImGuiTestContext*)>& steps) {
  interface.settle(4);
  const Scene before = interface.scene();
  const std::vector<float> picture = interface.picture();
  interface.run(steps);
  interface.settle(4);
  EXPECT_NE(interface.scene(), before);
  EXPECT_NE(interface.picture(), picture);
}

TEST(Panels, CameraOpensTheAperture) {
  Interface interface(small_scene());
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Camera");
    ctx->ItemInputValue("//Camera/##Aperture", 40.0F);
  });
  EXPECT_EQ(interface.scene().camera.lens_radius, 40);
}

TEST(Panels, CameraFocalLengthIsTheFieldOfView) {
  Interface interface(small_scene());
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Camera");
    ctx->ItemInputValue("//Camera/##Focal length", 50.0F);
  });
  EXPECT_NEAR(interface.scene().camera.vfov, 26.9915, 1e-3);
}

TEST(Panels, EnvironmentLightsUp) {
  Interface interface(small_scene());
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Environment");
    ctx->ItemInputValue("//Environment/##Strength", 2.0F);
  });
  interface.scene().environment.color = glm::dvec3(0.1);
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Environment");
    choose(ctx, "//Environment/##Type", "Gradient");
  });
  EXPECT_EQ(interface.scene().environment.kind, EnvironmentKind::Gradient);
  EXPECT_EQ(interface.scene().environment.strength, 2);
}

TEST(Panels, RenderSettingsRestartAndTheTargetDoesNot) {
  Interface interface(small_scene());
  interface.settle(4);
  const std::uint64_t generation = interface.application().generation();
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Render");
    ctx->ItemInputValue("//Render/##Samples", 6);
  });
  interface.settle(6);
  EXPECT_EQ(interface.application().generation(), generation);
  interface.run([](ImGuiTestContext* ctx) { ctx->ItemInputValue("//Render/##Width", 64); });
  interface.settle(1);
  EXPECT_GT(interface.application().generation(), generation);
  EXPECT_EQ(interface.bench().frame->image.width, 64);
}

TEST(Panels, StrategiesShowTheSameSceneWithOtherNoise) {
  Interface interface(small_scene());
  for (const auto& [name, strategy] :
       {std::pair{"Lights only", Strategy::Lights}, {"BSDF only", Strategy::Bsdf}}) {
    expect_new_picture(interface, [name = name](ImGuiTestContext* ctx) {
      ctx->WindowFocus("//Render");
      choose(ctx, "//Render/##Strategy", name);
    });
    EXPECT_EQ(interface.scene().render.strategy, strategy);
  }
}

TEST(Panels, SamplerShowsTheSameSceneWithOtherNoise) {
  Interface interface(small_scene());
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Render");
    choose(ctx, "//Render/##Sampler", "Independent");
  });
  EXPECT_EQ(interface.scene().render.sampler, SamplerKind::Independent);
}

TEST(Panels, HowSamplesAreSpentIsSet) {
  Interface interface(small_scene());
  interface.settle(1);
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Render");
    choose(ctx, "//Render/##Light choice", "Power");
    ctx->ItemClick("//Render/##Adaptive");
  });
  EXPECT_EQ(interface.scene().render.light_choice, LightChoiceBy::Power);
  EXPECT_TRUE(interface.scene().render.adaptive);
}

TEST(Panels, ThreadsStartTheSessionAgain) {
  Interface interface(small_scene());
  interface.settle(1);
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Render");
    ctx->ItemInputValue("//Render/##Threads", 2);
  });
  interface.settle(4);
  EXPECT_EQ(interface.bench().status.threads, 2);
}

TEST(Panels, ObjectsAreAddedHiddenDuplicatedRenamedAndDeleted) {
  Interface interface(small_scene());
  const std::size_t count = interface.scene().objects.size();
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Scene");
    ctx->ItemClick("//Scene/**/###Add object");
    ctx->ItemClick("//$FOCUSED/Sphere");
  });
  ASSERT_EQ(interface.scene().objects.size(), count + 1);
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Properties");
    ctx->ItemInputValue("//Properties/**/##Object", "ball");
  });
  EXPECT_EQ(interface.scene().objects.back().name, "ball");
  expect_new_picture(interface,
                     [](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_D); });
  EXPECT_EQ(interface.scene().objects.back().name, "ball 2");
  expect_new_picture(interface, [](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_Delete); });
  EXPECT_EQ(interface.scene().objects.size(), count + 1);
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Properties");
    ctx->ItemUncheck("//Properties/**/##Visible");
  });
  EXPECT_FALSE(interface.scene().objects.back().visible);
}

TEST(Panels, PropertiesEditShapeTransformAndMaterial) {
  Interface interface(small_scene());
  const int index = object_named(interface.scene(), "pyramid");
  ASSERT_NE(index, kNone);
  interface.bench().editor.selection = {ItemKind::Object, index};
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Properties");
    ctx->ItemInputValue("//Properties/**/##Angle", 10.0F);
  });
  expect_new_picture(interface, [&](ImGuiTestContext* ctx) {
    ctx->ItemInputValue(properties_of(interface, "##Vertex 1/$$1").c_str(), 260.0F);
  });
  const Object& pyramid = interface.scene().objects[static_cast<std::size_t>(index)];
  EXPECT_EQ(pyramid.transform.degrees, 10);
  EXPECT_EQ(std::get<PyramidShape>(pyramid.shape).vertices[0].y, 260);
  const int material = pyramid.material;
  interface.run([](ImGuiTestContext* ctx) { ctx->ItemClick("//Properties/**/Edit material"); });
  EXPECT_EQ(interface.bench().editor.selection, (Selection{ItemKind::Material, material}));
  expect_new_picture(interface, [&](ImGuiTestContext* ctx) {
    choose(ctx, properties_of(interface, "##Type").c_str(), "Metal");
    ctx->ItemInputValue("//Properties/**/##Roughness", 0.3F);
  });
  const Material& edited = interface.scene().materials[static_cast<std::size_t>(material)];
  EXPECT_EQ(edited.kind, MaterialKind::Metal);
  EXPECT_NEAR(edited.roughness, 0.3, 1e-6);
}

TEST(Panels, LightsAreAddedAndTurnedUp) {
  Interface interface(small_scene());
  const std::size_t count = interface.scene().objects.size();
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Lights");
    ctx->ItemClick("//Lights/**/###Add light");
  });
  ASSERT_EQ(interface.scene().objects.size(), count + 1);
  EXPECT_TRUE(emits(interface.scene().materials.back()));
  EXPECT_EQ(interface.bench().status.scene.lights, 4);
  expect_new_picture(interface, [](ImGuiTestContext* ctx) {
    ctx->ItemInputValue("//Lights/**/##Strength", 30.0F);
  });
  EXPECT_EQ(interface.scene().materials.back().emissive_strength, 30);
}

TEST(Panels, MaterialsAndTexturesAreAddedAndAssigned) {
  Interface interface(small_scene());
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Materials");
    ctx->ItemClick("//Materials/**/###Add texture");
    ctx->ItemClick("//$FOCUSED/Checker");
  });
  ASSERT_EQ(interface.scene().textures.back().kind, TextureKind::Checker);
  interface.run([](ImGuiTestContext* ctx) {
    ctx->ItemClick("//Materials/**/###Add material");
    ctx->ItemClick("//$FOCUSED/Matte");
  });
  const int material = static_cast<int>(interface.scene().materials.size()) - 1;
  ASSERT_EQ(interface.bench().editor.selection, (Selection{ItemKind::Material, material}));
  interface.run([&](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Properties");
    choose(ctx, properties_of(interface, "##Texture").c_str(), "Checker");
  });
  EXPECT_EQ(interface.scene().materials.back().base_color_texture,
            static_cast<int>(interface.scene().textures.size()) - 1);
  interface.bench().editor.selection = {ItemKind::Object, object_named(interface.scene(), "floor")};
  const std::string name = interface.scene().materials.back().name;
  expect_new_picture(interface, [&](ImGuiTestContext* ctx) {
    choose(ctx, properties_of(interface, "##Material").c_str(), name.c_str());
  });
}

TEST(Panels, ExposureAndToneMapKeepTheRender) {
  Interface interface(small_scene());
  interface.settle(4);
  const std::uint64_t generation = interface.application().generation();
  const std::vector<std::uint8_t> before = interface.screen();
  interface.run([](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiKey_LeftBracket);
    choose(ctx, "//Picture/##tone map", "ACES");
  });
  EXPECT_EQ(interface.scene().display.exposure, -0.5);
  EXPECT_EQ(interface.scene().display.tone_map, ToneMap::Aces);
  EXPECT_EQ(interface.application().generation(), generation);
  EXPECT_NE(interface.screen(), before);
}

TEST(Panels, StatisticsNameTheFirstDroppedSampleAndCopyTheCommandThatShowsIt) {
  Scene scene = small_scene();
  scene.materials[0].emissive = glm::dvec3(0);
  scene.environment.color = {1, 1, -1};  // no file can say this
  scene.objects.clear();
  scene.render.seed = 7;
  Interface interface(scene, small_scene_file());
  ASSERT_TRUE(interface.wait([&] { return interface.bench().status.counters.non_finite > 0; }));
  const Counters counters = interface.bench().status.counters;
  EXPECT_EQ(counters.bad_fault, Fault::Negative);
  std::string copied;
  interface.run([&](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Statistics");
    ctx->ItemClick("//Statistics/Copy replay command");
    const char* text = ImGui::GetClipboardText();  // the test engine's own
    if (text != nullptr) copied = text;
  });
  EXPECT_NE(copied.find("--seed 7"), std::string::npos) << copied;
  const auto& bad = counters.bad;
  EXPECT_NE(copied.find("--debug-sample " + std::to_string(bad.x) + "," + std::to_string(bad.y) +
                        "," + std::to_string(bad.sample)),
            std::string::npos)
      << copied;
}

}  // namespace
}  // namespace lightbench::ui
