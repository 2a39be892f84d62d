// Samples that the film cannot take are counted by cause and can be looked at one by one.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/program.h"

namespace lightbench {
namespace {

// Seen from within two nested balls of index 100, the world is 10^8 times brighter: beyond the
// film.
constexpr const char* kTooBright = R"({"lightbench": 1,
  "camera": {"lookFrom": [0, 0, 0], "lookAt": [0, 0, -1], "vfov": 20},
  "render": {"resolution": [8, 8], "spp": 4, "seed": 3},
  "environment": {"type": "constant", "color": [1, 1, 1]},
  "materials": [{"name": "dense glass", "type": "dielectric", "ior": 100, "baseColor": [1, 1, 1]}],
  "objects": [{"name": "shell", "type": "sphere", "radius": 2, "material": "dense glass"},
              {"name": "core", "type": "sphere", "radius": 1, "material": "dense glass"}]})";

constexpr const char* kLamp = R"({"lightbench": 1,
  "camera": {"lookFrom": [0, 0, 6], "lookAt": [0, 0, 0], "vfov": 20},
  "render": {"resolution": [9, 9], "spp": 4, "maxDepth": 3},
  "materials": [{"name": "grey", "type": "lambertian"},
                {"name": "glow", "type": "emissive", "emissive": [4, 4, 4]}],
  "objects": [{"name": "ball", "type": "sphere", "material": "grey"},
              {"name": "lamp", "type": "sphere", "center": [0, 0, 8], "radius": 0.5,
               "material": "glow"}]})";

TEST(CliDebugSample, DroppedSamplesAreCountedByCauseAndReplayable) {
  const TemporaryFolder folder;
  write_text(folder.path() / "it's.json", kTooBright);
  const ProgramResult result =
      run_lightbench(folder.path(), {"render", "it's.json", "-o", "a.pfm", "--stats-json",
                                     "stats.json", "--set", "/objects/1/radius=0.9"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto stats = nlohmann::json::parse(read_text(folder.path() / "stats.json"));
  const int dropped = stats["nonFiniteSamples"].get<int>();
  ASSERT_GT(dropped, 0);
  EXPECT_EQ(stats["nonFiniteCauses"]["beyondFilm"], dropped);
  EXPECT_EQ(stats["nonFiniteCauses"]["nan"], 0);
  const auto& first = stats["firstNonFinite"];
  EXPECT_EQ(first["cause"], "beyond the film's range");
  const auto replay = first["replay"].get<std::string>();
  EXPECT_NE(result.out.find(replay), std::string::npos) << "the summary names it too";
  const std::string sample = std::to_string(first["pixel"][0].get<int>()) + "," +
                             std::to_string(first["pixel"][1].get<int>()) + "," +
                             std::to_string(first["sample"].get<int>());
  EXPECT_EQ(replay.rfind("lightbench render 'it'\\''s.json' --set /objects/1/radius=0.9 "
                         "--resolution 8x8 --depth 50 --seed 3 --kernel ",
                         0),
            0U)
      << replay;
  EXPECT_NE(replay.find(" --debug-sample " + sample), std::string::npos) << replay;

  // The words after the quoted name, as a shell would pass them.
  std::vector<std::string> arguments{"render", "it's.json"};
  std::istringstream words(replay.substr(replay.find("--set")));
  for (std::string word; words >> word;) arguments.push_back(word);
  const ProgramResult path = run_lightbench(folder.path(), arguments);
  EXPECT_EQ(path.exit_code, 0) << path.err;
  EXPECT_NE(path.out.find("dropped       beyond the film's range"), std::string::npos) << path.out;
  EXPECT_NE(path.out.find("dense glass"), std::string::npos) << path.out;
}

TEST(CliDebugSample, PrintsWhatEachVertexAddsAndWhyItEnded) {
  const TemporaryFolder folder;
  write_text(folder.path() / "s.json", kLamp);
  const ProgramResult result =
      run_lightbench(folder.path(), {"render", "s.json", "--debug-sample", "4,4,2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* part :
       {"pixel 4,4 sample 2 of seed 0", "'ball' from outside, material 'grey' (lambertian)",
        "light      'lamp' chosen with probability 1", "adds (", "scatters   to (", "pdf ",
        "ends       ", "radiance      (", "film          adds ("}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
  }
  EXPECT_EQ(
      run_lightbench(folder.path(), {"render", "s.json", "--debug-sample", "9,0,0"}).exit_code, 2);
  const ProgramResult bad =
      run_lightbench(folder.path(), {"render", "s.json", "--debug-sample", "1,2"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("--debug-sample '1,2': expected x,y,k"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace lightbench
