// The command line when all goes well, or is stopped.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/unit/program.h"

namespace lightbench {
namespace {

constexpr const char* kScene = R"({"lightbench": 1,
  "camera": {"lookFrom": [0, 0, 4], "lookAt": [0, 0, 0]},
  "render": {"resolution": [24, 16], "spp": 4, "snapshots": [1, 2, 50], "seed": 7},
  "environment": {"type": "constant", "color": [0.25, 0.25, 0.25]},
  "materials": [{"name": "grey", "type": "lambertian"},
                {"name": "lamp", "type": "emissive", "emissive": [4, 4, 4]}],
  "objects": [{"name": "ball", "type": "sphere", "material": "grey"},
              {"name": "lamp", "type": "sphere", "center": [2, 2, 1], "radius": 0.5,
               "material": "lamp"}]})";

class Cli : public testing::Test {
 protected:
  void SetUp() override { write_text(folder.path() / "s.json", kScene); }
  ProgramResult run(const std::vector<std::string>& arguments) {
    return run_lightbench(folder.path(), arguments);
  }
  std::string content(const std::string& name) { return read_text(folder.path() / name); }

  TemporaryFolder folder;
};

TEST_F(Cli, VersionAndHelpOfEachSubcommand) {
  const ProgramResult version = run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  for (const char* word : {"lightbench ", "compiler: ", "kernels:", "reference", "(auto)"}) {
    EXPECT_NE(version.out.find(word), std::string::npos) << version.out;
  }
  const ProgramResult help = run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command : {"view", "render", "screenshot", "info", "compare", "query"}) {
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
    const ProgramResult of_command = run({command, "--help"});
    EXPECT_EQ(of_command.exit_code, 0) << command;
    EXPECT_NE(of_command.out.find("Usage: "), std::string::npos) << of_command.out;
  }
}

TEST_F(Cli, WritesEachCountInEachFormat) {
  const ProgramResult result =
      run({"render", "s.json", "--spp", "3,1", "-o", "out/{scene}-{spp}.png", "-o",
           "{seed}_{width}x{height}_{spp}.exr", "--threads", "2"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"7_24x16_1.exr", "7_24x16_3.exr",
                                                      "out/s-1.png", "out/s-3.png", "s.json"}));
  EXPECT_NE(result.out.find("no non-finite samples"), std::string::npos) << result.out;
}

TEST_F(Cli, SceneDecidesWhereFlagsAreSilent) {
  ASSERT_EQ(run({"render", "s.json", "-o", "last.pfm"}).exit_code, 0);
  ASSERT_EQ(run({"render", "s.json", "-o", "{spp}.pfm"}).exit_code, 0);
  ASSERT_EQ(run({"render", "s.json"}).exit_code, 0);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"1.pfm", "2.pfm", "4.pfm", "last.pfm",
                                                      "s-1.png", "s-2.png", "s-4.png", "s.json"}));
  EXPECT_EQ(content("last.pfm"), content("4.pfm"));
}

TEST_F(Cli, ThreadsAndOtherCountsDoNotChangeABit) {
  ASSERT_EQ(run({"render", "s.json", "--spp", "1,5,11", "-o", "a{spp}.pfm", "-t", "1"}).exit_code,
            0);
  ASSERT_EQ(run({"render", "s.json", "--spp", "11", "-o", "b.pfm", "-t", "5"}).exit_code, 0);
  ASSERT_EQ(run({"render", "s.json", "--spp", "5", "-o", "c.pfm", "-t", "-1"}).exit_code, 0);
  EXPECT_EQ(content("a11.pfm"), content("b.pfm"));
  EXPECT_EQ(content("a5.pfm"), content("c.pfm"));
  EXPECT_NE(content("a5.pfm"), content("a11.pfm"));
}

TEST_F(Cli, FlagsAndDefinitionsOverrideTheScene) {
  const std::string plain = "plain.json", flags = "flags.json", set = "set.json";
  ASSERT_EQ(run({"render", "s.json", "-o", "a.pfm", "--stats-json", plain}).exit_code, 0);
  ASSERT_EQ(run({"render",       "s.json",  "-o",       "b.pfm",  "--resolution", "10x12",
                 "--crop",       "1,2,4,5", "--seed",   "9",      "--depth",      "2",
                 "--spp",        "2",       "--kernel", "scalar", "--exposure",   "-1",
                 "--stats-json", flags})
                .exit_code,
            0);
  ASSERT_EQ(run({"render", "s.json", "-o", "c.pfm", "-D", "/render/resolution=[10,12]", "-D",
                 "/render/crop=[1,2,4,5]", "-D", "/render/seed=9", "-D", "/render/maxDepth=2", "-D",
                 "/render/spp=2", "--stats-json", set})
                .exit_code,
            0);
  EXPECT_EQ(content("b.pfm"), content("c.pfm"));
  const auto a = nlohmann::json::parse(content(plain));
  const auto b = nlohmann::json::parse(content(flags));
  EXPECT_EQ(a["resolution"], nlohmann::json({24, 16}));
  EXPECT_EQ(a["stoppedBy"], "target");
  EXPECT_EQ(a["samples"], 4 * 24 * 16);
  EXPECT_EQ(a["nonFiniteSamples"], 0);
  EXPECT_GT(a["peakMemoryBytes"], 1 << 20);
  EXPECT_EQ(a["pictures"].size(), 1U);
  EXPECT_EQ(b["resolution"], nlohmann::json({10, 12}));
  EXPECT_EQ(b["crop"], nlohmann::json({1, 2, 4, 5}));
  EXPECT_EQ(b["seed"], 9);
  EXPECT_EQ(b["kernel"], "scalar");
  EXPECT_EQ(b["samples"], 2 * 4 * 5);
}

TEST_F(Cli, AdaptiveSamplingIsAFlagOrASetting) {
  const auto render = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", "s.json", "--spp",        "64",
                                       "-o",     name,     "--stats-json", name + ".json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exit_code, 0);
    return nlohmann::json::parse(content(name + ".json"));
  };
  const auto plain = render("a.pfm", {});
  const auto flag = render("b.pfm", {"--adaptive"});
  render("c.pfm", {"-D", "/render/adaptive=true"});
  render("d.pfm", {"-D", "/render/adaptive=true", "--no-adaptive"});
  EXPECT_EQ(content("b.pfm"), content("c.pfm"));
  EXPECT_EQ(content("a.pfm"), content("d.pfm"));
  EXPECT_NE(content("a.pfm"), content("b.pfm"));
  EXPECT_EQ(plain["leastSamples"], 64);
  EXPECT_EQ(plain["mostSamples"], 64);
  EXPECT_LT(flag["leastSamples"], 64);
  EXPECT_GT(flag["mostSamples"], 64);
  EXPECT_EQ(flag["samples"], plain["samples"]);
  EXPECT_EQ(run({"render", "s.json", "--adaptive", "--no-adaptive"}).exit_code, 2);
}

TEST_F(Cli, TimeLimitSavesAndExitsWith5) {
  const ProgramResult result = run({"render", "s.json", "--spp", "1,2000000000", "--time-limit",
                                    "0.3s", "-o", "x-{spp}.pfm", "--stats-json", "stats.json"});
  EXPECT_EQ(result.exit_code, 5) << result.err;
  const auto stats = nlohmann::json::parse(content("stats.json"));
  EXPECT_EQ(stats["stoppedBy"], "time limit");
  const auto spp = stats["spp"].get<int>();
  EXPECT_GT(spp, 1);
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"s.json", "stats.json", "x-1.pfm",
                                                      "x-" + std::to_string(spp) + ".pfm"}));
  EXPECT_EQ(
      run({"render", "s.json", "--spp", "0", "--time-limit", "0.2s", "-o", "y.png"}).exit_code, 0)
      << "without a target the time limit is the target";
}

TEST_F(Cli, InterruptSavesAPartialPicture) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
    const TemporaryFolder out;
    Program program(folder.path(),
                    {"render", "s.json", "--spp", "1,2000000000", "-o",
                     (out.path() / "{spp}.pfm").string(), "--resolution", "200x200"});
    // The first picture says that the render has begun.
    const auto start = std::chrono::steady_clock::now();
    while (!std::filesystem::exists(out.path() / "1.pfm")) {
      ASSERT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
      std::this_thread::yield();
    }
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_EQ(result.exit_code, code) << result.err;
    const auto names = out.names();
    ASSERT_EQ(names.size(), 2U);
    EXPECT_NE(names[1].find(".partial.pfm"), std::string::npos) << names[1];
    EXPECT_NE(result.out.find(names[1]), std::string::npos) << result.out;
  }
}

TEST_F(Cli, PlainProgressAndNone) {
  const ProgramResult none = run({"render", "s.json", "-o", "a.png", "--progress", "none"});
  EXPECT_EQ(none.err, "");
  EXPECT_NE(none.out.find("a.png  4 spp"), std::string::npos) << none.out;
}

TEST_F(Cli, InfoDescribesTheScene) {
  const ProgramResult text = run({"info", "s.json"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("2 (2 sphere)"), std::string::npos) << text.out;
  const ProgramResult result =
      run({"info", "s.json", "--json", "--kernel", "scalar", "-D", "/objects/0/visible=false"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const auto info = nlohmann::json::parse(result.out);
  EXPECT_EQ(info["shapes"]["sphere"], 2);
  EXPECT_EQ(info["lights"], 1);
  EXPECT_EQ(info["kernel"], "scalar");
  EXPECT_EQ(info["filmBytes"], 24 * 16 * 32);
  EXPECT_FALSE(info["features"].empty());
  ASSERT_EQ(info["warnings"].size(), 1U);
  EXPECT_NE(info["warnings"][0].get<std::string>().find("(ball) is hidden"), std::string::npos);
}

TEST_F(Cli, CompareMeasuresAndGates) {
  ASSERT_EQ(run({"render", "s.json", "--spp", "1,8", "-o", "{spp}.pfm"}).exit_code, 0);
  ASSERT_EQ(run({"render", "s.json", "-o", "small.pfm", "--resolution", "8x8"}).exit_code, 0);
  const auto same = nlohmann::json::parse(run({"compare", "8.pfm", "8.pfm", "--json"}).out);
  for (const char* key : {"mse", "relMSE", "max", "meanSignedDifference"}) EXPECT_EQ(same[key], 0);
  const ProgramResult differ = run({"compare", "1.pfm", "8.pfm", "--json"});
  EXPECT_EQ(differ.exit_code, 0);
  EXPECT_GT(nlohmann::json::parse(differ.out)["relMSE"], 0);
  EXPECT_EQ(run({"compare", "1.pfm", "8.pfm", "--max-relmse", "1e6"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "8.pfm", "8.pfm", "--max-relmse", "0"}).exit_code, 0);
  EXPECT_EQ(run({"compare", "1.pfm", "8.pfm", "--max-relmse", "1e-9"}).exit_code, 6);
  const ProgramResult sizes = run({"compare", "small.pfm", "8.pfm"});
  EXPECT_EQ(sizes.exit_code, 3);
  EXPECT_NE(sizes.err.find("8x8"), std::string::npos) << sizes.err;
}

TEST_F(Cli, CompareComputesTheFormulas) {
  // Two 1x1 PFM images, little-endian: (1, 2, 3) against (1, 1, 4).
  const auto pfm = [](float r, float g, float b) {
    const float values[] = {r, g, b};
    return "PF\n1 1\n-1.0\n" + std::string(reinterpret_cast<const char*>(values), sizeof values);
  };
  write_text(folder.path() / "a.pfm", pfm(1, 2, 3));
  write_text(folder.path() / "b.pfm", pfm(1, 1, 4));
  const auto d = nlohmann::json::parse(run({"compare", "a.pfm", "b.pfm", "--json"}).out);
  EXPECT_NEAR(d["mse"], 2.0 / 3, 1e-12);
  EXPECT_NEAR(d["relMSE"], (1 / 1.01 + 1 / 16.01) / 3, 1e-12);
  EXPECT_NEAR(d["max"], 1, 1e-12);
  EXPECT_NEAR(d["meanSignedDifference"], 0, 1e-12);
  EXPECT_EQ(d["meanSignedDifferenceRgb"], nlohmann::json({0.0, 1.0, -1.0}));
  write_text(folder.path() / "nan.pfm", pfm(1, NAN, 4));
  EXPECT_EQ(run({"compare", "nan.pfm", "b.pfm", "--max-relmse", "100"}).exit_code, 6);
}

}  // namespace
}  // namespace lightbench
