// The short form of `lightbench stress`: every line passes.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/stress/suite.h"
#include "tests/unit/program.h"

namespace lightbench {
namespace {

using Json = nlohmann::json;

TEST(Stress, TheShortFormPasses) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"stress", "--json", "table.json", "--threads", "1"};
#ifdef __SANITIZE_ADDRESS__  // a tenth of the speed: a part of the suite
  arguments.insert(arguments.end(), {"--filter", "leave"});
#endif
  const ProgramResult result = run_lightbench(folder.path(), arguments);
  ASSERT_TRUE(result.exit_code == 0 || result.exit_code == 6) << result.err;
  const Json report = Json::parse(read_text(folder.path() / "table.json"));
  for (const Json& line : report["lines"]) {
    EXPECT_GT(line["trials"].get<std::uint64_t>(), 0U) << line["line"];
    EXPECT_TRUE(line["pass"].get<bool>()) << line.dump(2);
  }
  EXPECT_EQ(report["failed"].get<int>(), 0);
  EXPECT_EQ(result.exit_code, 0);
}

TEST(Stress, AChunkThatFailedIsRunAgainAlone) {
  const TemporaryFolder folder;
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"stress", "--filter", "cylinder, hit", "--kernel",
                                       "double", "--json",   "table.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run_lightbench(folder.path(), arguments).exit_code, 0);
    Json report = Json::parse(read_text(folder.path() / "table.json"));
    EXPECT_EQ(report["lines"].size(), 1U);
    report["lines"][0].erase("testSeconds");
    return report["lines"];
  };
  const Json once = run({"--chunk", "3"});
  EXPECT_EQ(once, run({"--chunk", "3", "--threads", "2"}));
  EXPECT_NE(once[0]["trials"], run({"--chunk", "4"})[0]["trials"]);
  EXPECT_NE(once[0]["trials"], run({"--chunk", "3", "--seed", "2"})[0]["trials"]);
  EXPECT_LT(once[0]["trials"], run({"--threads", "2"})[0]["trials"]);
}

// At the allowed share half a failure is expected of 500,000 trials, 100 of 1e8.
TEST(Stress, FailuresPassUpToTheirShareAndOneAlone) {
  const auto passes = [](double allowed, std::uint64_t trials, int failures) {
    stress::LineResult result;
    result.allowed = allowed;
    result.tally.trial(trials);
    for (int i = 0; i < failures; ++i) result.tally.fail([] { return std::string(); });
    return result.passed();
  };
  EXPECT_TRUE(passes(1e-6, 500000, 1));
  EXPECT_FALSE(passes(1e-6, 500000, 2));
  EXPECT_TRUE(passes(1e-6, 100000000, 100));
  EXPECT_FALSE(passes(1e-6, 100000000, 101));
  EXPECT_TRUE(passes(0, 1000, 0));
  EXPECT_FALSE(passes(0, 1000000000, 1));
  EXPECT_FALSE(passes(1, 0, 0));
}

TEST(Stress, AMeasuredNanFailsAndStays) {
  stress::Tally tally(10, 0);
  const auto text = [] { return std::string(); };
  tally.measure(std::numeric_limits<double>::quiet_NaN(), text);
  tally.measure(1, text);
  EXPECT_EQ(tally.failures(), 1U);
  EXPECT_TRUE(std::isnan(tally.worst()));
}

TEST(Stress, AFilterThatNoTestMatchesIsAnError) {
  const TemporaryFolder folder;
  const ProgramResult result = run_lightbench(folder.path(), {"stress", "--filter", "nonsense"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--filter 'nonsense'"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace lightbench
