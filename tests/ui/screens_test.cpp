// The look of the whole interface, against stored pictures (references/README.md).

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "core/film/image_file.h"
#include "core/film/tone_map.h"
#include "core/scene/scene_io.h"
#include "tests/ui/interface.h"
#include "tests/ui/screen_comparison.h"
#include "ui/script.h"

namespace lightbench::ui {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr int kStatusTop = 692;
const fs::path kReferences = fs::path(LIGHTBENCH_SOURCE_DIR) / "tests" / "ui" / "references";
const fs::path kFindings = fs::temp_directory_path() / "lightbench-screens";
// Times, speeds and memory: what follows the state in the status bar.
constexpr Rectangle kStatusValues{405, kStatusTop, kWidth, kHeight};

Screen read_screen(const fs::path& file) {
  const Image image = read_image(file);
  return {image.width, image.height, to_8_bit(image, Display{})};
}

void write_screen(const fs::path& file, const Screen& screen) {
  Image image{screen.width, screen.height, {}};
  for (const std::uint8_t value : screen.rgb) {
    image.rgb.push_back(linear_from_srgb(static_cast<float>(value) / 255));
  }
  write_image(file, image, Display{});
}

/// The interface on the scene of the references, after `steps`, with the picture finished.
Screen screen_after(const json& steps) {
  const fs::path file = kReferences / "scene.json";
  GlContext gl(GlBackend::OSMesa, kWidth, kHeight, "");
  Application application(gl, load_scene(file), file, test_options(), [] {});
  run_script(application, gl, steps);
  while (application.bench().status.state != SessionState::Finished) {
    wait_for_samples(application, 400);
  }
  run_script(application, gl, {{{"frames", 3}}});
  return {kWidth, kHeight, gl.read_rgb()};
}

constexpr Rectangle kAll{0, 0, kWidth, kHeight};
constexpr Rectangle kLists{0, 24, 237, kStatusTop};
constexpr Rectangle kProperties{944, 24, kWidth, kStatusTop};

struct Case {
  const char* name;
  Rectangle part;  ///< of the screen, which is compared and stored
  json steps;
  std::vector<Rectangle> masks;  ///< within the part
};

void PrintTo(const Case& test, std::ostream* stream) { *stream << test.name; }

std::vector<Case> cases() {
  return {
      {"start", kAll, json::array({{{"select", "panel"}}}), {kStatusValues}},
      {"lights_statistics",
       kLists,
       {{{"show", "Lights"}}, {{"show", "Statistics"}}},
       {{80, 456, 226, 668}}},  // the values in Statistics
      {"materials", kLists, {{{"select", "matte"}}, {{"show", "Materials"}}}, {}},
      {"material", kProperties, {{{"select", "matte"}}, {{"show", "Properties"}}}, {}},
      {"camera", kProperties, json::array({{{"show", "Camera"}}}), {}},
      {"environment", kProperties, json::array({{{"show", "Environment"}}}), {}},
      {"render", kProperties, json::array({{{"show", "Render"}}}), {}},
      {"keys", {237, 24, 944, kStatusTop}, json::array({{{"key", "f1"}}}), {}},
  };
}

class Screens : public testing::TestWithParam<Case> {};

TEST_P(Screens, LookAsTheyDid) {
  const std::string name = GetParam().name;
  const fs::path reference = kReferences / (name + ".png");
  const Screen actual = crop(screen_after(GetParam().steps), GetParam().part);
  if (std::getenv("LIGHTBENCH_RENEW_SCREENS") != nullptr) {
    write_screen(reference, actual);
    GTEST_SKIP() << reference << " is renewed: look at it before it is committed";
  }
  const ScreenComparison comparison =
      compare_screens(read_screen(reference), actual, GetParam().masks);
  if (comparison.difference.empty()) return;
  write_screen(kFindings / (name + "-actual.png"), actual);
  write_screen(kFindings / (name + "-difference.png"), comparison.picture);
  ADD_FAILURE() << comparison.difference << "\n  expected   " << reference.string()
                << "\n  actual     " << (kFindings / (name + "-actual.png")).string()
                << "\n  difference " << (kFindings / (name + "-difference.png")).string();
}

INSTANTIATE_TEST_SUITE_P(Interface, Screens, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

/// The start screen, changed as bugs and other releases of libraries would change it.
class ScreenComparisonTest : public testing::Test {
 protected:
  /// What is found when the pixels of `part` are replaced.
  std::string found(const Rectangle& part, const std::function<int(std::size_t at)>& value) const {
    Screen changed = start_;
    for (int y = part.top; y < part.bottom; ++y) {
      for (int x = part.left; x < part.right; ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = 3 * static_cast<std::size_t>(y * kWidth + x) + c;
          changed.rgb[at] = static_cast<std::uint8_t>(std::clamp(value(at), 0, 255));
        }
      }
    }
    return compare_screens(start_, changed, {}).difference;
  }
  [[nodiscard]] int at(std::size_t offset) const { return start_.rgb[offset]; }

  const Screen start_ = read_screen(kReferences / "start.png");
  const Rectangle properties_{948, 50, kWidth - 2, 690};
};

TEST_F(ScreenComparisonTest, SeesAPanelThatMovedByAPixel) {
  EXPECT_NE(found(properties_, [&](std::size_t i) { return at(i - 3); }), "");
  EXPECT_NE(found(properties_, [&](std::size_t i) { return at(i - 3 * kWidth); }), "");
}

TEST_F(ScreenComparisonTest, SeesAPanelThatVanished) {
  EXPECT_NE(found(properties_, [&](std::size_t) { return 38; }), "");
}

TEST_F(ScreenComparisonTest, SeesTheNextGrey) {
  EXPECT_NE(found(properties_, [&](std::size_t i) { return at(i) + 2; }), "");
}

TEST_F(ScreenComparisonTest, SeesATextThatLostALetter) {
  // The M of "Materials" in the menu's row of tabs.
  EXPECT_NE(found({130, 30, 144, 44}, [&](std::size_t) { return 27; }), "");
}

TEST_F(ScreenComparisonTest, ForgivesRoundingAndAntialiasing) {
  const Rectangle all{2, 2, kWidth - 2, kHeight - 2};
  const auto rounded = [&](std::size_t i) { return at(i) + static_cast<int>(i % 3) - 1; };
  EXPECT_EQ(found(all, rounded), "");
  // A fifth of a pixel aside, as another rasterizer of glyphs may place them.
  const auto aside = [&](std::size_t i) { return (4 * at(i) + at(i - 3)) / 5; };
  EXPECT_EQ(found(properties_, aside), "");
}

TEST_F(ScreenComparisonTest, LooksAwayFromMasks) {
  Screen changed = start_;
  std::fill(changed.rgb.begin(), changed.rgb.end(), std::uint8_t{200});
  EXPECT_EQ(compare_screens(start_, changed, {{0, 0, kWidth, kHeight}}).difference, "");
}

}  // namespace
}  // namespace lightbench::ui
