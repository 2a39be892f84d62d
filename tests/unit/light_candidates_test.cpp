// Which images of lights, in mirrors and in glass spheres, a point chooses between.

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
  EXPECT_EQ(c.view.mirror_count, 1U);
  EXPECT_EQ(c.view.lens_count, 14U);
  EXPECT_EQ(c.view.candidate_count, kMaxLightCandidates);
}

TEST(LightCandidates, AMirrorThatFitsIsNotLostToThoseThatDoNot) {
  Scene s = two_lamps();
  for (int i = 0; i < 40; ++i) {
    s.objects.push_back(object(RectangleShape{{2.0 * i, -5, -1}, {0, 0, 2}, {1, 0, 0}}, kMirror));
  }
  EXPECT_EQ(compiled(s).view.mirror_count, 15U);
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
