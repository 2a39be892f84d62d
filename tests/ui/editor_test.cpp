#include "ui/editor.h"

#include <gtest/gtest.h>

#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {

TEST(Editor, UndoAndRedoWalkTheSteps) {
  Editor editor(new_scene());
  const Scene start = editor.scene;
  editor.scene.camera.vfov = 50;
  EXPECT_EQ(editor.commit(), "");
  editor.scene.camera.vfov = 60;
  EXPECT_EQ(editor.commit(), "");
  ASSERT_TRUE(editor.undo());
  EXPECT_EQ(editor.scene.camera.vfov, 50);
  ASSERT_TRUE(editor.undo());
  EXPECT_EQ(editor.scene, start);
  EXPECT_FALSE(editor.undo());
  ASSERT_TRUE(editor.redo());
  ASSERT_TRUE(editor.redo());
  EXPECT_EQ(editor.scene.camera.vfov, 60);
  EXPECT_FALSE(editor.redo());
}

TEST(Editor, AnEditAfterUndoForgetsWhatWasAhead) {
  Editor editor(new_scene());
  editor.scene.camera.vfov = 50;
  editor.commit();
  editor.undo();
  editor.scene.camera.vfov = 70;
  editor.commit();
  EXPECT_FALSE(editor.can_redo());
  EXPECT_EQ(editor.scene.camera.vfov, 70);
}

TEST(Editor, UndoTakesBackAnEditThatWasNotCommitted) {
  Editor editor(new_scene());
  const Scene start = editor.scene;
  editor.scene.camera.vfov = 50;
  EXPECT_TRUE(editor.can_undo());
  ASSERT_TRUE(editor.undo());
  EXPECT_EQ(editor.scene, start);
}

TEST(Editor, AnInvalidSceneIsPutBackWithAReason) {
  Editor editor(new_scene());
  const Scene start = editor.scene;
  editor.scene.camera.vfov = 500;
  const std::string reason = editor.commit();
  EXPECT_NE(reason.find("/camera/vfov"), std::string::npos) << reason;
  EXPECT_EQ(editor.scene, start);
  EXPECT_FALSE(editor.can_undo());
}

TEST(Editor, DirtyMeansDifferentFromTheFile) {
  Editor editor(new_scene(), "somewhere/box.json");
  EXPECT_FALSE(editor.dirty());
  EXPECT_EQ(editor.title(), "box");
  editor.scene.camera.vfov = 50;
  EXPECT_TRUE(editor.dirty());
  editor.saved(editor.scene, "elsewhere/other.json");
  EXPECT_FALSE(editor.dirty());
  EXPECT_EQ(editor.title(), "other");
  editor.undo();
  EXPECT_TRUE(editor.dirty());
}

TEST(Editor, ASelectionThatIsUndoneAwayIsCleared) {
  Editor editor(new_scene());
  editor.selection = add_light(editor.scene);
  editor.commit();
  editor.undo();
  EXPECT_EQ(editor.selection, Selection{});
}

}  // namespace
}  // namespace lightbench::ui
