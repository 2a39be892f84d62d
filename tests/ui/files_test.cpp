// Opening, saving, snapshots, and what the user is told when they fail.

#include <gtest/gtest.h>
#include <imgui.h>

#include <fstream>

#include "core/film/image_file.h"
#include "core/scene/scene_io.h"
#include "tests/ui/interface.h"
#include "ui/panels.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {
namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("lightbench-ui-" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(Files, SaveAsWritesWhatIsEditedAndOpenReadsItBack) {
  Interface interface(small_scene());
  interface.settle(1);
  interface.scene().camera.vfov = 33;
  interface.run([&](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_S);
    ctx->SetRef("//$FOCUSED");
    ctx->ItemInputValue("##folder", folder_.c_str());
    ctx->ItemInputValue("##name", "copy");
  });
  const fs::path file = folder_ / "copy.json";
  ASSERT_TRUE(interface.wait([&] { return !interface.bench().editor.dirty(); }));
  EXPECT_EQ(interface.bench().editor.file(), file);
  EXPECT_EQ(load_scene(file).camera.vfov, 33);
  interface.scene().camera.vfov = 44;
  interface.run([](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_O);
    ctx->ItemClick("//Save changes?/Discard");
    ctx->SetRef("//$FOCUSED");
    ctx->ItemInputValue("##name", "copy.json");
  });
  ASSERT_TRUE(interface.wait([&] { return interface.scene().camera.vfov == 33; }));
  EXPECT_FALSE(interface.bench().editor.can_undo());
}

TEST_F(Files, ABrokenSceneIsReportedAndTheOldOneStays) {
  std::ofstream(folder_ / "broken.json") << R"({"lightbench": 1, "camera": {"vfov": -3}})";
  Interface interface(small_scene(), folder_ / "here.json");
  const Scene before = interface.scene();
  interface.run([](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_O);
    ctx->SetRef("//$FOCUSED");
    ctx->ItemInputValue("##name", "broken.json");
  });
  ASSERT_TRUE(interface.wait([&] { return !interface.bench().notice.text.empty(); }));
  EXPECT_NE(interface.bench().notice.text.find("/camera/vfov"), std::string::npos);
  EXPECT_EQ(interface.scene(), before);
}

TEST_F(Files, SnapshotNowIsWrittenAndListed) {
  Interface interface(small_scene());
  interface.bench().snapshots.pattern = (folder_ / "{scene}-{spp}.exr").string();
  interface.settle(4);
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_F12); });
  const auto& entries = interface.bench().snapshots.entries();
  ASSERT_TRUE(interface.wait([&] { return !entries.empty() && entries.front()->written; }));
  EXPECT_EQ(entries.front()->spp, 4U);
  EXPECT_NE(entries.front()->thumbnail.texture(), 0U);
  const Image image = read_image(folder_ / "untitled-4.exr");
  EXPECT_EQ(image.width, 40);
}

TEST_F(Files, FunctionKeysWorkWhileANumberIsTyped) {
  Interface interface(small_scene());
  interface.bench().snapshots.pattern = (folder_ / "{scene}-{spp}.exr").string();
  interface.settle(4);
  const Scene before = interface.scene();
  interface.run([](ImGuiTestContext* ctx) {
    ctx->WindowFocus("//Camera");
    ctx->ItemInput("//Camera/##Aperture");
    IM_CHECK(ImGui::GetIO().WantTextInput);
    ctx->KeyPress(ImGuiKey_Delete);  // the field's, not the selected object's
    ctx->KeyPress(ImGuiKey_F12);
    ctx->KeyPress(ImGuiKey_Escape);
  });
  const auto& entries = interface.bench().snapshots.entries();
  ASSERT_TRUE(interface.wait([&] { return !entries.empty() && entries.front()->written; }));
  EXPECT_EQ(interface.scene(), before);
}

TEST_F(Files, ASecondSnapshotOfTheSameNameIsNumbered) {
  std::ofstream(folder_ / "untitled-4-2.exr") << "somebody else's";
  Interface interface(small_scene());
  // Also where the count is one of those written by themselves.
  interface.scene().render.snapshots = {4};
  interface.bench().snapshots.pattern = (folder_ / "{scene}-{spp}.exr").string();
  interface.settle(4);
  const auto& entries = interface.bench().snapshots.entries();
  const auto snapshot = [&] {
    const std::size_t count = entries.size() + 1;
    interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_F12); });
    return interface.wait([&] {
      return entries.size() == count && entries.front()->written &&
             interface.bench().jobs.pending() == 0;
    });
  };
  ASSERT_TRUE(snapshot());
  const Image first = read_image(folder_ / "untitled-4.exr");
  // The edit makes another picture, and the file it would be written to by itself.
  interface.bench().snapshots.automatic = true;
  interface.scene().environment.color = glm::dvec3(1);
  interface.settle(4);
  ASSERT_TRUE(interface.wait([&] {
    return fs::exists(folder_ / "untitled-4-3.exr") && interface.bench().jobs.pending() == 0;
  }));
  ASSERT_TRUE(snapshot());
  EXPECT_EQ(read_image(folder_ / "untitled-4.exr").rgb, first.rgb);
  EXPECT_NE(read_image(folder_ / "untitled-4-3.exr").rgb, first.rgb);
  EXPECT_TRUE(fs::exists(folder_ / "untitled-4-4.exr"));
  EXPECT_EQ(fs::file_size(folder_ / "untitled-4-2.exr"), 15U);
  EXPECT_EQ(entries.size(), 3U);
}

TEST_F(Files, AnEditReplacesOnlyWhatTheSameRunWroteByItself) {
  std::ofstream(folder_ / "untitled-2.ppm") << "of an earlier run";
  Scene scene = small_scene();
  scene.render.snapshots = {2};
  Interface interface(std::move(scene));
  interface.bench().snapshots.pattern = (folder_ / "{scene}-{spp}.ppm").string();
  interface.bench().snapshots.automatic = true;
  const auto written = [&] {
    interface.settle(4);
    EXPECT_TRUE(interface.wait([&] {
      const auto& entries = interface.bench().snapshots.entries();
      return !entries.empty() && entries.front()->written && interface.bench().jobs.pending() == 0;
    }));
    return read_image(folder_ / "untitled-2-2.ppm").rgb;
  };
  interface.bench().request(Action::Restart);
  const std::vector<float> before = written();
  interface.scene().camera.vfov = 60;
  EXPECT_NE(written(), before);
  EXPECT_EQ(fs::file_size(folder_ / "untitled-2.ppm"), 17U);
  EXPECT_FALSE(fs::exists(folder_ / "untitled-2-3.ppm"));
}

TEST_F(Files, SnapshotsComeAtTheCountsAndGoOn) {
  Scene scene = small_scene();
  scene.render.snapshots = {2, 5};
  scene.render.spp = 8;
  Interface interface(std::move(scene));
  interface.bench().snapshots.pattern = (folder_ / "{scene}-{spp}.png").string();
  interface.bench().snapshots.automatic = true;
  interface.bench().request(Action::Restart);
  ASSERT_TRUE(interface.wait([&] { return interface.bench().snapshots.entries().size() == 2; }));
  ASSERT_TRUE(interface.wait([&] { return interface.bench().jobs.pending() == 0; }));
  EXPECT_TRUE(fs::exists(folder_ / "untitled-2.png"));
  EXPECT_TRUE(fs::exists(folder_ / "untitled-5.png"));
}

TEST_F(Files, AnUnwritableSnapshotIsShownAsSuch) {
  Interface interface(small_scene());
  std::ofstream(folder_ / "file") << "not a folder";
  interface.bench().snapshots.pattern = (folder_ / "file" / "x.png").string();
  interface.settle(4);
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_F12); });
  const auto& entries = interface.bench().snapshots.entries();
  ASSERT_TRUE(interface.wait([&] { return !entries.empty() && !entries.front()->error.empty(); }));
  EXPECT_FALSE(entries.front()->written);
}

TEST_F(Files, QuitAsksAboutUnsavedChanges) {
  Interface interface(small_scene(), folder_ / "scene.json");
  interface.scene().camera.vfov = 20;
  interface.run([](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Q);
    ctx->ItemClick("//Save changes?/Cancel");
  });
  EXPECT_FALSE(interface.application().closing());
  interface.run([](ImGuiTestContext* ctx) {
    ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Q);
    ctx->ItemClick("//Save changes?/Save");
  });
  ASSERT_TRUE(interface.wait([&] { return interface.application().closing(); }));
  EXPECT_EQ(load_scene(folder_ / "scene.json").camera.vfov, 20);
}

TEST(SnapshotPath, FillsInSceneAndCount) {
  EXPECT_EQ(snapshot_path("out/{scene}-{spp}spp.png", "box", 200), fs::path("out/box-200spp.png"));
  EXPECT_EQ(snapshot_path("{scene}/{scene}.exr", "a", 1), fs::path("a/a.exr"));
}

}  // namespace
}  // namespace lightbench::ui
