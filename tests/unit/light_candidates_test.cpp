// Which images of lights, in mirrors and in glass, a point chooses between.

#include <gtest/gtest.h>

#include "core/compile/parts.h"
#include "core/compile/render_scene.h"

namespace lightbench {
namespace {

enum : int { kLamp, kMirror, kGlass, kDark };

Object object(const Shape& shape, int material) {
  Object o;
  o.shape = shape;
  o.material = material;
  return o;
}

Object ball(double x, double radius, int material) {
  return object(SphereShape{{x, 0, 0}, radius, {0, 0, 0}}, material);
}

/// Two lamps over a row of things to come.
Scene two_lamps() {
  Scene s;
  s.render.width = s.render.height = 8;
  s.materials.resize(4);
  s.materials[kLamp].emissive = glm::dvec3(1);
  s.materials[kMirror].kind = MaterialKind::Metal;
  s.materials[kGlass].kind = MaterialKind::Dielectric;
  for (const double x : {-1, 1}) {
    s.objects.push_back(object(SphereShape{{x, 20, 0}, 0.5, {0, 0, 0}}, kLamp));
  }
  return s;
}

struct Compiled {
  std::shared_ptr<const RenderScene> scene;
  SceneView<float> view;
};
Compiled compiled(const Scene& s) {
  Compiled c{compile(s, KernelKind::Scalar), {}};
  c.view = std::get<KernelParts<float>>(c.scene->parts->kernel).view;
  return c;
}

/// Number 13 of a lens' row.
bool crowded(const Compiled& c, std::uint32_t lens) {
  return c.view.lenses[lens * kLensStride + 13] > 0;
}

TEST(LightCandidates, ImagesThatDoNotFitAreLeftOutAloneAndMirrorsComeFirst) {
  Scene s = two_lamps();
  s.objects.push_back(object(RectangleShape{{-1, -5, -1}, {0, 0, 2}, {2, 0, 0}}, kMirror));
  for (int i = 0; i < 20; ++i) s.objects.push_back(ball(3.0 * i, 1, kGlass));
  const Compiled c = compiled(s);
  EXPECT_EQ(c.view.direct_candidates, 2U);
  EXPECT_EQ(c.view.face_count, 1U);
  EXPECT_EQ(c.view.lens_count, 14U);
  EXPECT_EQ(c.view.candidate_count, kMaxWithImages);
}

TEST(LightCandidates, AMirrorThatFitsIsNotLostToThoseThatDoNot) {
  Scene s = two_lamps();
  for (int i = 0; i < 40; ++i) {
    s.objects.push_back(object(RectangleShape{{2.0 * i, -5, -1}, {0, 0, 2}, {1, 0, 0}}, kMirror));
  }
  EXPECT_EQ(compiled(s).view.face_count, 15U);
}

TEST(LightCandidates, HollowSpheresAreNoLensesAndCrowdedOnesAreKnown) {
  Scene s = two_lamps();
  s.objects.push_back(ball(0, 1, kGlass));    // alone
  s.objects.push_back(ball(5, 1, kGlass));    // hollow
  s.objects.push_back(ball(5, 0.9, kGlass));  // within it: alone
  s.objects.push_back(ball(10, 1, kGlass));   // another reaches into it
  s.objects.push_back(ball(11.5, 0.9, kDark));
  s.objects.push_back(ball(15, 1, kGlass));  // with a hidden ball inside
  s.objects.push_back(ball(15, 0.5, kDark));
  s.objects.back().visible = false;
  s.objects.push_back(ball(20, 1, kGlass));  // murky
  s.media.resize(1);
  s.objects.back().medium = 0;
  s.objects.push_back(ball(30, 1, kGlass));  // touched by a box
  s.objects.push_back(object(BoxShape{{29, 1, -1}, {31, 2, 1}}, kDark));
  const Compiled c = compiled(s);
  ASSERT_EQ(c.view.lens_count, 6U);
  const bool expected[] = {false, true, true, false, true, false};
  for (std::uint32_t l = 0; l < 6; ++l) EXPECT_EQ(crowded(c, l), expected[l]) << l;
}

Object cube(double x, double half, int material) {
  return object(BoxShape{{x - half, -half, -half}, {x + half, half, half}}, material);
}

/// The primitives of the panes and whether they are crowded; boxes come in the scene's order.
struct Pane {
  std::uint32_t primitive;
  bool crowded;
  bool operator==(const Pane&) const = default;
};
std::vector<Pane> panes(const Compiled& c) {
  std::vector<Pane> all;
  for (std::uint32_t f = c.view.mirror_count; f < c.view.face_count; ++f) {
    const float* row = c.view.faces + f * kFaceStride;
    all.push_back({static_cast<std::uint32_t>(row[13]), row[20] > 0});
  }
  return all;
}

TEST(LightCandidates, PanesAreTheFacesBelowWhichSomethingIsLit) {
  Scene s = two_lamps();
  s.objects.push_back(cube(0, 2, kGlass));
  // With nothing below it no light can fall through, from lamps that are above it.
  EXPECT_EQ(panes(compiled(s)).size(), 0U);
  s.objects.push_back(object(RectangleShape{{-9, -3, -9}, {0, 0, 18}, {18, 0, 0}}, kDark));
  const std::uint32_t box = compiled(s).view.kind_begin[unsigned(PrimitiveKind::Box)];
  EXPECT_EQ(panes(compiled(s)), (std::vector<Pane>{{box, false}}));
  // Standing on it, nothing is before the lower face.
  std::get<RectangleShape>(s.objects.back().shape).corner.y = -2;
  EXPECT_EQ(panes(compiled(s)).size(), 0U);
  // Less dense than what is around it, it may reflect all light.
  std::get<RectangleShape>(s.objects.back().shape).corner.y = -3;
  s.materials[kGlass].ior = 0.7;
  EXPECT_EQ(panes(compiled(s)).size(), 0U);
}

TEST(LightCandidates, HollowBoxesAreNoPanesAndCrowdedOnesAreKnown) {
  Scene s = two_lamps();
  s.objects.push_back(object(RectangleShape{{-99, -3, -99}, {0, 0, 198}, {198, 0, 0}}, kDark));
  s.objects.push_back(cube(0, 1, kGlass));  // with a ball inside
  s.objects.push_back(ball(0, 0.5, kDark));
  s.objects.push_back(cube(10, 1, kGlass));  // a ball reaches into it
  s.objects.push_back(ball(11.5, 0.9, kDark));
  s.objects.push_back(cube(20, 1, kGlass));  // stands on something as large as itself
  s.objects.push_back(object(BoxShape{{19, -2, -1}, {21, -1, 1}}, kDark));
  const Compiled c = compiled(s);
  const std::uint32_t box = c.view.kind_begin[unsigned(PrimitiveKind::Box)];
  for (const Pane& p : panes(c)) {
    EXPECT_NE(p.primitive, box);
    EXPECT_EQ(p.crowded, p.primitive == box + 1);
  }
  EXPECT_EQ(panes(c).front().primitive, box + 1);
  EXPECT_EQ(panes(c).back().primitive, box + 2);
}

TEST(LightCandidates, NoLampsNoImages) {
  Scene s = two_lamps();
  s.materials[kLamp].emissive = glm::dvec3(0);
  s.objects.push_back(ball(0, 1, kGlass));
  const Compiled c = compiled(s);
  EXPECT_EQ(c.view.lens_count, 0U);
  EXPECT_EQ(c.view.candidate_count, 0U);
}

}  // namespace
}  // namespace lightbench
