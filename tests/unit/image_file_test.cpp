// Images through every format, the headers that viewers rely on, and files that lie.

#include "core/film/image_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "core/error.h"
#include "core/film/tone_map.h"
#include "core/scene/scene_io.h"
#include "tests/unit/temporary_folder.h"

namespace lightbench {
namespace {

Image random_image(int width, int height, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::exponential_distribution<float> radiance(1.0F);
  Image image{width, height, {}};
  image.rgb.resize(3 * image.pixel_count());
  for (float& value : image.rgb) value = radiance(engine);
  return image;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void expect_read_error(const std::filesystem::path& file, const std::string& reason) {
  try {
    static_cast<void>(read_image(file));
    FAIL() << file;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::Scene);
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(file.string() + ": cannot be read: ")) << message;
    EXPECT_NE(message.find(reason), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(ImageFile, PfmIsExact) {
  const TemporaryFolder folder;
  Image image = random_image(17, 9);
  image.rgb[5] = std::numeric_limits<float>::infinity();
  image.rgb[6] = -2;
  write_image(folder / "a.pfm", image, {});
  const Image read = read_image(folder / "a.pfm");
  EXPECT_EQ(read.width, 17);
  EXPECT_EQ(read.height, 9);
  EXPECT_EQ(read.rgb, image.rgb);
}

TEST(ImageFile, PfmOfTheOtherEndiannessAndGreyIsRead) {
  const TemporaryFolder folder;
  const std::string one("\x3f\x80\x00\x00", 4);
  const std::string two("\x40\x00\x00\x00", 4);
  const auto file = folder.write("grey.pfm", "Pf\n1 2\n1.0\n" + one + two);
  EXPECT_EQ(read_image(file).rgb, (std::vector<float>{2, 2, 2, 1, 1, 1}));  // bottom row first
}

TEST(ImageFile, ExrHoldsHalfPrecision) {
  const TemporaryFolder folder;
  Image image = random_image(33, 21);
  image.rgb[0] = 1e9F;  // beyond half: the largest half, not infinity
  write_image(folder / "a.exr", image, {5, ToneMap::Aces});  // linear: the display does not matter
  const Image read = read_image(folder / "a.exr");
  ASSERT_EQ(read.rgb.size(), image.rgb.size());
  EXPECT_EQ(read.rgb[0], 65504);
  for (std::size_t i = 1; i < read.rgb.size(); ++i)
    EXPECT_NEAR(read.rgb[i], image.rgb[i], image.rgb[i] * 0x1p-11F + 1e-7F);
}

TEST(ImageFile, ExrCarriesVarianceChromaticitiesAndText) {
  const TemporaryFolder folder;
  const Image image = random_image(5, 3);
  std::vector<float> variance(15);
  for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = 1.0F / static_cast<float>(i + 3);
  write_image(folder / "a.exr", image, {}, {{"scene", "caf\xc3\xa9"}, {"samplesPerPixel", "200"}},
              variance);
  Imf::InputFile file((folder / "a.exr").c_str());
  const Imf::Header& header = file.header();
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("samplesPerPixel").value(), "200");
  EXPECT_EQ(header.typedAttribute<Imf::StringAttribute>("scene").value(), "caf\xc3\xa9");
  ASSERT_TRUE(Imf::hasChromaticities(header));
  EXPECT_FLOAT_EQ(Imf::chromaticities(header).red.x, 0.64F);
  EXPECT_FLOAT_EQ(Imf::chromaticities(header).white.y, 0.329F);
  EXPECT_EQ(header.channels()["R"].type, Imf::HALF);
  EXPECT_EQ(header.channels()["variance.Y"].type, Imf::FLOAT);
  EXPECT_EQ(header.lineOrder(), Imf::INCREASING_Y);
  std::vector<float> read(15);
  Imf::FrameBuffer frame;
  frame.insert("variance.Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(read.data()),
                                        sizeof(float), 5 * sizeof(float)));
  file.setFrameBuffer(frame);
  file.readPixels(0, 2);
  EXPECT_EQ(read, variance);
}

TEST(ImageFile, HdrHoldsSharedExponents) {
  const TemporaryFolder folder;
  for (const int width : {5, 40}) {  // below 8 the format stores rows flat, else run-length coded
    Image image = random_image(width, 11);
    image.rgb[3] = -1;
    image.rgb[4] = std::numeric_limits<float>::quiet_NaN();
    write_image(folder / "a.hdr", image, {});
    const Image read = read_image(folder / "a.hdr");
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, 11);
    for (std::size_t i = 6; i < read.rgb.size(); i += 3) {
      const float peak = std::max({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]});
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(read.rgb[i + c], image.rgb[i + c], peak / 128);
    }
    EXPECT_EQ(read.rgb[3], 0);
    EXPECT_EQ(read.rgb[4], 0);
  }
}

TEST(ImageFile, PngAndPpmHoldTheDisplayedBytes) {
  const TemporaryFolder folder;
  const Image image = random_image(31, 7);
  const Display display{-0.5, ToneMap::Reinhard};
  const std::vector<std::uint8_t> expected = to_8_bit(image, display);
  for (const char* name : {"a.png", "b.PPM"}) {
    write_image(folder / name, image, display);
    const Image linear = read_image(folder / name);
    ASSERT_EQ(linear.width, 31);
    EXPECT_EQ(to_8_bit(linear, {}), expected) << name;
    const Image raw = read_image(folder / name, false);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_FLOAT_EQ(raw.rgb[i], static_cast<float>(expected[i]) / 255);
  }
}

TEST(ImageFile, PngHasAnSrgbChunkAndText) {
  const TemporaryFolder folder;
  write_image(folder / "a.png", random_image(4, 4), {},
              {{"software", "Lightbench"}, {"scene", "caf\xc3\xa9"}, {std::string(100, 'k'), "v"}});
  const std::string bytes = bytes_of(folder / "a.png");
  EXPECT_NE(bytes.find("sRGB"), std::string::npos);
  EXPECT_NE(bytes.find(std::string("Software\0\0\0\0\0Lightbench", 23)), std::string::npos);
  EXPECT_NE(bytes.find(std::string("scene\0\0\0\0\0caf\xc3\xa9", 15)), std::string::npos);
  EXPECT_EQ(read_image(folder / "a.png").width, 4);
}

TEST(ImageFile, SixteenBitPpmIsRead) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "a.ppm", std::string("P6 # a comment\n1 1\n65535\n\xff\xff\x80\x00\x00\x00", 31));
  const Image image = read_image(file, false);
  EXPECT_EQ(image.rgb[0], 1);
  EXPECT_FLOAT_EQ(image.rgb[1], 32768.0F / 65535);
  EXPECT_EQ(image.rgb[2], 0);
}

TEST(ImageFile, TexturesAreFiniteAndNotNegative) {
  const TemporaryFolder folder;
  const Image image{2,
                    1,
                    {std::numeric_limits<float>::quiet_NaN(), -1, 0.5F,
                     std::numeric_limits<float>::infinity(), 7, 1e30F}};
  write_image(folder / "a.pfm", image, {});
  EXPECT_EQ(*load_image(folder / "a.pfm", true),
            make_texels({2, 1, {0, 0, 0.5F, 1e12F, 7, 1e12F}}));
}

TEST(ImageFile, NamesAreCheckedBeforeALongRender) {
  for (const char* good : {"a.png", "x/y.EXR", "a.b.hdr", "a.pfm", "a.ppm"})
    EXPECT_NO_THROW(check_image_name(good));
  for (const char* bad : {"a", "a.jpg", "png", ".png", "a.png.tmp", ""}) {
    try {
      check_image_name(bad);
      FAIL() << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Usage);
      EXPECT_EQ(std::string(error.what()),
                std::string(bad) + ": expected a name that ends in .png, .exr, .hdr, .pfm or .ppm");
    }
  }
}

TEST(ImageFile, WritingCreatesFoldersAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_image(folder / "new/deep/a.png", random_image(2, 2), {});
  write_image(folder / "new/deep/a.png", random_image(3, 3), {});
  EXPECT_EQ(read_image(folder / "new/deep/a.png").width, 3);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    files += entry.is_regular_file() ? 1U : 0U;
  EXPECT_EQ(files, 1U);
}

TEST(ImageFile, UnwritablePlacesAreOneLineErrors) {
  const TemporaryFolder folder;
  folder.write("file", "x");
  std::filesystem::create_directory(folder / "folder.png");
  for (const auto& file : {folder / "file/a.png", folder / "folder.png",
                           std::filesystem::path("/proc/lightbench/a.png")}) {
    try {
      write_image(file, random_image(2, 2), {});
      FAIL() << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::Output);
      EXPECT_TRUE(std::string(error.what()).starts_with(file.string() + ": cannot be written: "))
          << error.what();
    }
  }
  EXPECT_EQ(folder.file_count(), 2U);
}

TEST(ImageFile, AWrongSizeIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_image(folder / "a.png", Image{2, 2, {1, 2, 3}}, {}), Error);
  EXPECT_THROW(write_image(folder / "a.png", Image{}, {}), Error);
  EXPECT_THROW(write_image(folder / "a.exr", random_image(2, 2), {}, {}, {1, 2, 3}), Error);
  EXPECT_EQ(folder.file_count(), 0U);
}

TEST(ImageFile, FilesThatLie) {
  const TemporaryFolder folder;
  expect_read_error(folder / "none.png", "No such file");
  expect_read_error(folder.path(), "not a regular file");
  expect_read_error(folder.write("empty.png", ""), "expected a PNG, JPEG, EXR, HDR, PFM or PPM");
  expect_read_error(folder.write("text.png", "hello"), "expected a PNG");
  expect_read_error(folder.write("huge.ppm", "P6 65536 65536 255\n"), "at most 134217728 pixels");
  expect_read_error(folder.write("wide.ppm", "P6 2000000000 1 255\n"), "at most 134217728 pixels");
  expect_read_error(folder.write("short.ppm", "P6 30000 4000 255\n123"), "too short");
  expect_read_error(folder.write("end.ppm", "P6 2 2 255\n123"), "ends too early");
  expect_read_error(folder.write("zero.ppm", "P6 0 2 255\n123"), "empty");
  expect_read_error(folder.write("max.ppm", "P6 1 1 0\n123"), "maximum of 1 to 65535");
  expect_read_error(folder.write("word.ppm", "P6 x 1 255\n123"), "expected a number");
  expect_read_error(folder.write("minus.pfm", "PF\n-1 1\n-1.0\n123"), "empty");
  expect_read_error(folder.write("scale.pfm", "PF\n1 1\n0\n123456789012"), "scale");
  expect_read_error(folder.write("end.pfm", "PF\n2 2\n-1.0\n123"), "ends too early");
  expect_read_error(folder.write("bad.hdr", "#?RADIANCE\nhello"), "");
  expect_read_error(folder.write("bad.exr", std::string("\x76\x2f\x31\x01", 4)), "too early");
  expect_read_error(folder.write("bad.jpg", "\xff\xd8\xff\xe0"), "");
}

TEST(ImageFile, TruncatedAndFlippedFilesNeverCrash) {
  const TemporaryFolder folder;
  std::mt19937 engine(4);
  for (const char* name : {"a.png", "a.exr", "a.hdr", "a.pfm", "a.ppm"}) {
    write_image(folder / name, random_image(20, 13), {}, {{"scene", "x"}});
    const std::string whole = bytes_of(folder / name);
    int refused = 0;
    for (int i = 0; i < 120; ++i) {
      std::string bytes = whole;
      const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(engine()) % n; };
      if (i % 3 == 0) bytes.resize(pick(bytes.size()));
      for (std::size_t flips = pick(4); flips-- > 0 && !bytes.empty();)
        bytes[pick(std::min<std::size_t>(bytes.size(), i % 2 == 0 ? 64 : bytes.size()))] =
            static_cast<char>(engine());
      try {
        const Image image = read_image(folder.write("broken", bytes));
        EXPECT_EQ(image.rgb.size(), 3 * image.pixel_count());
      } catch (const Error&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 20) << name;
  }
}

}  // namespace
}  // namespace lightbench
