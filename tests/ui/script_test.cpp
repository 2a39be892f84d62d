// Scripts of `lightbench screenshot`: each step does what docs/viewer.md says.

#include "ui/script.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/film/image_file.h"
#include "core/scene/scene_io.h"
#include "tests/ui/interface.h"
#include "ui/script_input.h"

namespace lightbench::ui {
namespace {
using nlohmann::json;

/// An application without the test engine, as `lightbench screenshot` makes it.
struct Offscreen {
  GlContext gl{GlBackend::OSMesa, 1280, 720, ""};
  Application application;

  explicit Offscreen(double scale = 1)
      : application(gl, small_scene(), small_scene_file(), test_options(scale), [] {}) {
    wait_for_samples(application, 4);
  }
  Scene& scene() { return application.bench().editor.scene; }
  void run(const json& steps) { run_script(application, gl, steps); }
};

TEST(Script, ClicksTypesSelectsAndSets) {
  Offscreen ui;
  ui.run(
      {{{"click", "Camera/Aperture"}, {"with", "ctrl"}}, {{"type", "12.5"}}, {{"key", "enter"}}});
  EXPECT_EQ(ui.scene().camera.lens_radius, 12.5);
  ui.run({{{"key", "ctrl+z"}}});
  EXPECT_EQ(ui.scene().camera.lens_radius, 0);
  ui.run({{{"set", "/camera/vfov"}, {"value", 55}}, {{"select", "earth"}}});
  EXPECT_EQ(ui.scene().camera.vfov, 55);
  EXPECT_EQ(ui.application.bench().editor.selection.kind, ItemKind::Object);
  const Camera before = ui.scene().camera;
  ui.run(
      {{{"drag", "Picture/View"}, {"from", {0.5, 0.5}}, {"to", {0.6, 0.55}}}, {{"wait_spp", 2}}});
  EXPECT_NE(ui.scene().camera, before);
}

TEST(Script, SaysWhatIsWrong) {
  Offscreen ui;
  const auto message = [&](const json& steps) -> std::string {
    try {
      ui.run(steps);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({{{"clack", "x"}}}).find("/0"), std::string::npos);
  EXPECT_NE(message({{{"click", "Camera/Nothing"}}}).find("Camera/Aperture"), std::string::npos);
  EXPECT_NE(message({{{"set", "/camera/vfov"}, {"value", -1}}}).find("/camera/vfov"),
            std::string::npos);
  EXPECT_NE(message({{{"key", "ctrl+nonsense"}}}).find("nonsense"), std::string::npos);
  EXPECT_NE(message({{{"select", "nobody"}}}).find("nobody"), std::string::npos);
}

TEST(Script, TheScreenshotIsTheScreen) {
  Offscreen ui;
  const auto file = std::filesystem::temp_directory_path() / "lightbench-script-test.png";
  ui.run({{{"screenshot", file.string()}}});
  const Image image = read_image(file);
  std::filesystem::remove(file);
  EXPECT_EQ(image.width, 1280);
  EXPECT_EQ(image.height, 720);
}

/// No widget that can be seen leaves its window, in the default layout at both scales.
TEST(Layout, PictureDominatesAndNothingIsPushedOut) {
  for (const double scale : {1.0, 2.0}) {
    Offscreen ui(scale);
    for (const char* panel : {"Scene", "Lights", "Materials", "Camera", "Environment", "Render",
                              "Properties", "Statistics", "Snapshots"}) {
      ui.run({{{"select", "earth"}}, {{"show", panel}}});
      for (const auto& [name, place] : ui.application.gui().widgets().places) {
        if (!place.visible || name.starts_with("Tab/")) continue;  // tabs scroll
        EXPECT_GE(place.min.x, 0) << name << " at scale " << scale;
        EXPECT_LE(place.max.x, 1280) << name << " at scale " << scale;
      }
    }
    const WidgetMap::Place& view = ui.application.gui().widgets().places.at("Picture/View");
    const float share = (view.max.x - view.min.x) * (view.max.y - view.min.y) / (1280 * 720);
    EXPECT_GT(share, scale == 1.0 ? 0.45F : 0.35F);
  }
}

}  // namespace
}  // namespace lightbench::ui
