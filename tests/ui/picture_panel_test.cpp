// The mouse in the picture: camera, selection, focus; and the history behind it.

#include <gtest/gtest.h>
#include <imgui.h>

#include <glm/geometric.hpp>

#include "tests/ui/interface.h"
#include "ui/panels.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

/// Screen position of a fraction of the picture's view.
ImVec2 in_view(Interface& interface, float fx, float fy) {
  const WidgetMap::Place& view = interface.application().gui().widgets().places.at("Picture/View");
  return {view.min.x + fx * (view.max.x - view.min.x), view.min.y + fy * (view.max.y - view.min.y)};
}

void drag(Interface& interface, ImGuiMouseButton button, const ImVec2& delta) {
  const ImVec2 start = in_view(interface, 0.5F, 0.5F);
  interface.run([=](ImGuiTestContext* ctx) {
    ctx->MouseMoveToPos(start);
    ctx->MouseDragWithDelta(delta, button);
  });
}

TEST(PicturePanel, DragsMoveTheCameraAndAreOneStepEach) {
  Interface interface(small_scene());
  interface.settle(1);
  const Camera start = interface.scene().camera;
  drag(interface, ImGuiMouseButton_Left, {80, 30});
  const Camera orbited = interface.scene().camera;
  EXPECT_NEAR(glm::length(orbited.look_from - orbited.look_at),
              glm::length(start.look_from - start.look_at), 1e-6);
  EXPECT_NE(orbited, start);
  drag(interface, ImGuiMouseButton_Middle, {50, 0});
  const Camera panned = interface.scene().camera;
  EXPECT_NE(panned.look_at, orbited.look_at);
  drag(interface, ImGuiMouseButton_Right, {-40, 0});
  EXPECT_EQ(interface.scene().camera.look_from, panned.look_from);
  for (const Camera& expected : {panned, orbited, start}) {
    interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Z); });
    EXPECT_EQ(interface.scene().camera, expected);
  }
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiMod_Ctrl | ImGuiKey_Y); });
  EXPECT_EQ(interface.scene().camera, orbited);
  interface.settle(1);
}

TEST(PicturePanel, WheelAndKeysMoveTheCamera) {
  Interface interface(small_scene());
  interface.settle(1);
  const Camera start = interface.scene().camera;
  const ImVec2 middle = in_view(interface, 0.5F, 0.5F);
  interface.run([=](ImGuiTestContext* ctx) {
    ctx->MouseMoveToPos(middle);
    ctx->MouseWheelY(2);
  });
  EXPECT_GT(interface.scene().camera.look_from.z, start.look_from.z + 50);
  const Camera nearer = interface.scene().camera;
  interface.run([=](ImGuiTestContext* ctx) {
    ctx->MouseMoveToPos(middle);
    ctx->MouseDown(ImGuiMouseButton_Right);
    ctx->KeyHold(ImGuiKey_W, 0.3F);
    ctx->KeyHold(ImGuiKey_E, 0.3F);
    ctx->MouseUp(ImGuiMouseButton_Right);
  });
  EXPECT_GT(interface.scene().camera.look_from.z, nearer.look_from.z);
  EXPECT_GT(interface.scene().camera.look_from.y, nearer.look_from.y);
}

TEST(PicturePanel, ClickSelectsShiftClickFocusesCtrlClickSetsThePivot) {
  Interface interface(small_scene());
  interface.settle(1);
  // The back wall shows between the metal box and the cylinder.
  const ImVec2 wall = in_view(interface, 0.40F, 0.38F);
  interface.run([=](ImGuiTestContext* ctx) {
    ctx->MouseMoveToPos(wall);
    ctx->MouseClick();
  });
  const Editor& editor = interface.bench().editor;
  ASSERT_EQ(editor.selection.kind, ItemKind::Object);
  EXPECT_EQ(item_name(editor.scene, editor.selection), "back wall");
  interface.run([=](ImGuiTestContext* ctx) {
    ctx->MouseMoveToPos(wall);
    ctx->KeyDown(ImGuiMod_Shift);
    ctx->MouseClick();
    ctx->KeyUp(ImGuiMod_Shift);
    ctx->KeyDown(ImGuiMod_Ctrl);
    ctx->MouseClick();
    ctx->KeyUp(ImGuiMod_Ctrl);
  });
  EXPECT_NEAR(interface.scene().camera.focus_distance, 1355, 1e-3);
  ASSERT_TRUE(interface.bench().pivot);
  EXPECT_NEAR(interface.bench().pivot->z, 555, 1e-3);
}

TEST(PicturePanel, FrameSelectionAndAll) {
  Interface interface(small_scene());
  interface.settle(1);
  interface.bench().editor.selection = {ItemKind::Object, 0};
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_F); });
  const glm::dvec3 selected = interface.scene().camera.look_at;
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_Home); });
  EXPECT_NE(interface.scene().camera.look_at, selected);
}

TEST(PicturePanel, PauseAndResume) {
  Scene scene = small_scene();
  scene.render.spp = 0;
  Interface interface(std::move(scene));
  interface.settle(2);
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_Space); });
  EXPECT_TRUE(
      interface.wait([&] { return interface.bench().status.state == SessionState::Paused; }));
  interface.run([](ImGuiTestContext* ctx) { ctx->KeyPress(ImGuiKey_Space); });
  EXPECT_TRUE(
      interface.wait([&] { return interface.bench().status.state == SessionState::Rendering; }));
}

TEST(PicturePanel, AnIdleInterfaceAsksForNoMoreFrames) {
  Interface interface(small_scene());
  interface.settle(4);
  EXPECT_TRUE(
      interface.wait([&] { return interface.bench().status.state == SessionState::Finished; }));
  EXPECT_TRUE(
      interface.wait([&] { return interface.application().seconds_to_next_frame() > 1e6; }));
}

}  // namespace
}  // namespace lightbench::ui
