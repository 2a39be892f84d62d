// What the shader shows is what the files say.

#include "ui/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/film/tone_map.h"
#include "ui/gl_context.h"
#include "ui/picture_view.h"
#include "ui/refresh.h"

namespace lightbench::ui {
namespace {

/// Radiance over twelve decades, with the values that go wrong.
Image test_image() {
  Image image;
  image.width = 64;
  image.height = 48;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(image.pixel_count() - 1);
    image.rgb.push_back(static_cast<float>(std::pow(10.0, -6 + 12 * t)));
    image.rgb.push_back(static_cast<float>(2 * t));
    image.rgb.push_back(static_cast<float>(0.05 * t));
  }
  image.rgb[0] = -1;
  image.rgb[1] = 0;
  image.rgb[3] = std::numeric_limits<float>::infinity();
  image.rgb[4] = 1;
  return image;
}

TEST(Picture, ShaderAndFilesAgreeWithinOneStep) {
  const GlContext gl(GlBackend::OSMesa, 32, 32, "");
  Picture picture;
  const Image image = test_image();
  picture.upload(image);
  for (const ToneMap tone_map : {ToneMap::Srgb, ToneMap::Reinhard, ToneMap::Aces}) {
    for (const double exposure : {-6.0, -0.5, 0.0, 1.0 / 6, 4.0}) {
      const Display display{exposure, tone_map};
      picture.develop(display);
      const std::vector<std::uint8_t> shown = picture.read_rgb();
      const std::vector<std::uint8_t> saved = to_8_bit(image, display);
      ASSERT_EQ(shown.size(), saved.size());
      int worst = 0;
      for (std::size_t i = 0; i < shown.size(); ++i) {
        worst = std::max(worst, std::abs(int{shown[i]} - int{saved[i]}));
      }
      EXPECT_LE(worst, 1) << "tone map " << static_cast<int>(tone_map) << " exposure " << exposure;
    }
  }
}

TEST(Picture, FollowsItsSize) {
  const GlContext gl(GlBackend::OSMesa, 32, 32, "");
  Picture picture;
  EXPECT_EQ(picture.texture(), 0U);
  for (const int size : {8, 33, 5}) {
    Image image;
    image.width = size;
    image.height = 2 * size;
    image.rgb.assign(image.pixel_count() * 3, 1.0F);
    picture.upload(image);
    picture.develop({});
    EXPECT_EQ(picture.width(), size);
    EXPECT_EQ(picture.read_rgb(), std::vector<std::uint8_t>(image.rgb.size(), 255));
  }
}

TEST(PictureView, FitsAndKeepsTheAspect) {
  const ViewRegion region{{100, 50}, {800, 400}};
  EXPECT_DOUBLE_EQ(effective_zoom({}, region, {200, 200}), 2);
  EXPECT_EQ(picture_origin({}, region, {200, 200}), glm::dvec2(300, 50));
  EXPECT_DOUBLE_EQ(effective_zoom({}, region, {1600, 200}), 0.5);
}

TEST(PictureView, ZoomKeepsThePointUnderTheMouse) {
  const ViewRegion region{{100, 50}, {800, 400}};
  const glm::dvec2 picture(640, 480);
  const glm::dvec2 mouse(420, 260);
  PictureView view;
  const glm::dvec2 before = to_picture(view, region, picture, mouse);
  for (int i = 0; i < 10; ++i) view = zoom_at(view, region, picture, mouse, 1.3);
  const glm::dvec2 after = to_picture(view, region, picture, mouse);
  // Within a screen pixel, since pictures start on whole ones.
  EXPECT_NEAR(before.x, after.x, 1.01);
  EXPECT_NEAR(before.y, after.y, 1.01);
  for (int i = 0; i < 100; ++i) view = zoom_at(view, region, picture, mouse, 2);
  EXPECT_DOUBLE_EQ(view.zoom, 64);
}

TEST(PictureView, ScreenAndPictureAreInverse) {
  const ViewRegion region{{3, 7}, {500, 300}};
  const PictureView view =
      pan_by(zoom_at({}, region, {100, 80}, {200, 100}, 3), region, {100, 80}, {17, -5});
  const glm::dvec2 there = to_screen(view, region, {100, 80}, {12.5, 60});
  const glm::dvec2 back = to_picture(view, region, {100, 80}, there);
  EXPECT_NEAR(back.x, 12.5, 1e-9);
  EXPECT_NEAR(back.y, 60, 1e-9);
}

TEST(Refresh, GrowsAsThePictureSettlesAndNeverTakesMoreThanItsShare) {
  EXPECT_DOUBLE_EQ(refresh_interval(1, 0.1, 0.001), 0.1);
  EXPECT_DOUBLE_EQ(refresh_interval(1000, 60, 0.001), 2.0);
  double last = 0;
  for (std::uint32_t spp = 1; spp < 2000; spp *= 2) {
    const double interval = refresh_interval(spp, 0.5 * spp, 0.001);
    EXPECT_GE(interval, last);
    last = interval;
  }
  EXPECT_GE(refresh_interval(1, 0.1, 0.05), 0.5);
}

}  // namespace
}  // namespace lightbench::ui
