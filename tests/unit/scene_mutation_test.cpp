// Whatever a document holds, the loader either gives a valid scene or throws an Error of one line.

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "core/scene/scene_io.h"
#include "tests/unit/scene_mutations.h"

namespace lightbench {
namespace {

TEST(SceneMutation, TheUndamagedSceneUsesEveryShape) {
  const Scene scene = parse_scene(std::string(kWholeScene), ".", "whole");
  std::set<std::size_t> shapes;
  for (const Object& object : scene.objects) shapes.insert(object.shape.index());
  EXPECT_EQ(shapes.size(), std::variant_size_v<Shape>);
}

TEST(SceneMutation, DamageIsAnErrorOrAValidScene) {
  std::mt19937 engine(2024);
  int accepted = 0;
  std::set<std::string> messages;
  for (int i = 0; i < 10000; ++i) {
    const std::string text = damaged(std::string(kWholeScene), engine);
    try {
      const Scene scene = parse_scene(text, "/nowhere", "damaged");
      EXPECT_NO_THROW(validate(scene));
      EXPECT_NO_THROW(static_cast<void>(scene_to_json(scene, "/nowhere")));
      ++accepted;
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(error.kind(), ErrorKind::Scene) << message;
      EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << message;
      EXPECT_LT(message.size(), 400U) << message;
      messages.insert(message);
    }
  }
  // The damage reaches deep: many scenes survive, and the others fail in many ways.
  EXPECT_GT(accepted, 50);
  EXPECT_GT(messages.size(), 1500U);
}

}  // namespace
}  // namespace lightbench
