// Texels hold what the image held, in less where it has few values.

#include "core/scene/texels.h"

#include <gtest/gtest.h>

namespace lightbench {
namespace {

/// 100 x 7 pixels of `count` different values, mixed.
Image image_of(unsigned count) {
  Image image{100, 7, {}};
  for (unsigned i = 0; i < 2100; ++i)
    image.rgb.push_back(static_cast<float>(i * 37 % count) / 7.0F);
  return image;
}

void expect_equal(const Texels& texels, const Image& image) {
  ASSERT_EQ(texels.width, image.width);
  ASSERT_EQ(texels.height, image.height);
  ASSERT_EQ(texels.count(), image.pixel_count());
  for (std::size_t i = 0; i < texels.count(); ++i) {
    for (unsigned k = 0; k < 3; ++k) EXPECT_EQ(texels.color(i)[k], image.rgb[3 * i + k]);
  }
}

TEST(Texels, OfAtMost256ValuesTakeAThirdOfTheMemory) {
  for (const unsigned count : {1U, 2U, 255U, 256U}) {
    const Texels texels = make_texels(image_of(count));
    EXPECT_EQ(texels.packed.size(), 700U) << count;
    EXPECT_EQ(texels.values.size(), 256U) << count;
    EXPECT_TRUE(texels.rgb.empty()) << count;
    expect_equal(texels, image_of(count));
  }
}

TEST(Texels, OfMoreValuesStayAsTheyAre) {
  for (const unsigned count : {257U, 2000U}) {
    const Texels texels = make_texels(image_of(count));
    EXPECT_TRUE(texels.packed.empty()) << count;
    EXPECT_EQ(texels.rgb.size(), 2100U) << count;
    expect_equal(texels, image_of(count));
  }
}

TEST(Texels, KeepValuesThatDifferInTheLastBit) {
  Image image{1, 1, {0.5F, 0x1.000002p-1F, 1e12F}};
  expect_equal(make_texels(image), image);
}

}  // namespace
}  // namespace lightbench
