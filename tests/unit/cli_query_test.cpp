// lightbench query: what the JSON lines say, and what is said about lines that cannot be read.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/unit/program.h"

namespace lightbench {
namespace {

using nlohmann::json;

constexpr const char* kScene = R"({"lightbench": 1,
  "materials": [{"name": "grey", "type": "lambertian", "baseColor": [0.5, 0.25, 1]},
                {"name": "glow", "type": "emissive", "emissive": [3, 2, 1]},
                {"name": "glass", "type": "dielectric", "ior": 1.5},
                {"name": "silver", "type": "metal"},
                {"name": "pewter", "type": "metal", "fuzz": 0.5}],
  "meshes": [{"name": "tile", "positions": [[0,0,0], [1,0,0], [1,1,0], [0,1,0]],
              "triangles": [[0,1,2], [0,2,3]]}],
  "objects": [{"name": "ball", "type": "sphere", "radius": 2, "material": "grey"},
              {"name": "lamp", "type": "rectangle", "corner": [-1, 8, -1], "edgeU": [2, 0, 0],
               "edgeV": [0, 0, 2], "material": "glow"},
              {"name": "tiles", "type": "mesh", "mesh": "tile", "material": "grey",
               "transform": {"translation": [10, 0, 0]}}]})";

struct CliQuery : testing::Test {
  TemporaryFolder folder;
  void SetUp() override { write_text(folder.path() / "s.json", kScene); }

  ProgramResult run(const std::string& lines, std::vector<std::string> more = {}) {
    write_text(folder.path() / "in.jsonl", lines);
    std::vector<std::string> arguments{"query", "s.json", "--input", "in.jsonl"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lightbench(folder.path(), arguments);
  }
  std::vector<json> answers(const std::string& lines, const std::vector<std::string>& more = {}) {
    const ProgramResult result = run(lines, more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::vector<json> found;
    std::istringstream stream(result.out);
    for (std::string line; std::getline(stream, line);) found.push_back(json::parse(line));
    return found;
  }
};

void expect_near(const json& v, const std::vector<double>& expected, double tolerance = 1e-6) {
  ASSERT_EQ(v.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(v[i].get<double>(), expected[i], tolerance);
  }
}

TEST_F(CliQuery, HitsSayWhereAndWhat) {
  const auto a = answers(R"({"o": [0, 0, 10], "d": [0, 0, -2]}

{"o": [0, 0, 10], "d": [0, 1, 0]}
{"o": [10.25, 0.75, 5], "d": [0, 0, -1]}
{"o": [0, 0, 10], "d": [0, 0, -1], "tmin": 9}
{"o": [0, 0, 10], "d": [0, 0, -1], "tmax": 7.9}
{"o": [0, 0, 2], "d": [0, 0, -1], "from": {"object": "ball", "inside": true}}
{"o": [0, 0, 2], "d": [0, 0, 1], "from": {"object": "ball"}}
{"o": [10.25, 0.75, 5], "d": [0, 0, -1], "from": {"object": "tiles", "triangle": 1}}
)",
                         {"--kernel", "reference"});
  ASSERT_EQ(a.size(), 8U);
  EXPECT_EQ(a[0]["hit"], true);
  EXPECT_EQ(a[0]["t"], 4.0);
  expect_near(a[0]["p"], {0, 0, 2});
  expect_near(a[0]["ng"], {0, 0, 1});
  expect_near(a[0]["ns"], {0, 0, 1});
  EXPECT_EQ(a[0]["uv"].size(), 2U);
  EXPECT_EQ(a[0]["front"], true);
  EXPECT_EQ(a[0]["object"], "ball");
  EXPECT_EQ(a[0]["material"], "grey");
  EXPECT_FALSE(a[0].contains("triangle"));
  EXPECT_EQ(a[1], json::parse(R"({"hit": false})"));
  EXPECT_EQ(a[2]["object"], "tiles");
  EXPECT_EQ(a[2]["triangle"], 1);
  expect_near(a[2]["uv"], {0.25, 0.5});  // barycentric
  EXPECT_EQ(a[3]["t"], 12.0);
  EXPECT_EQ(a[3]["front"], false);
  EXPECT_EQ(a[4]["hit"], false);
  EXPECT_EQ(a[5]["t"], 4.0);
  EXPECT_EQ(a[6]["hit"], false);
  EXPECT_EQ(a[7]["hit"], false);
}

TEST_F(CliQuery, NumbersCarryTheirLastBit) {
  // A third is no binary fraction: only all digits give it back.
  const std::string line = R"({"o": [0.3, 0.1, 10], "d": [0, 0, -1]})";
  const ProgramResult result = run(line, {"--kernel", "reference"});
  const json hit = json::parse(result.out);
  const double z = std::sqrt(4 - 0.3 * 0.3 - 0.1 * 0.1);
  EXPECT_NEAR(hit["p"][2].get<double>(), z, 1e-15);
  EXPECT_NEAR(hit["t"].get<double>(), 10 - z, 1e-14);
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.17g", hit["t"].get<double>());
  EXPECT_NE(result.out.find(std::string("\"t\":") + digits + ","), std::string::npos) << result.out;
  // The float kernels know less.
  const json rough = json::parse(run(line, {"--kernel", "scalar"}).out);
  EXPECT_NE(rough["t"], hit["t"]);
  EXPECT_NEAR(rough["t"].get<double>(), 10 - z, 1e-5);
}

TEST_F(CliQuery, OcclusionIsYesOrNo) {
  const ProgramResult result =
      run("{\"o\": [0, 0, 10], \"d\": [0, 0, -1]}\n{\"o\": [0, 0, 10], \"d\": [0, 0, 1]}\n"
          "{\"o\": [0, 0, 10], \"d\": [0, 0, -1], \"tmax\": 7.9}",
          {"--any"});
  EXPECT_EQ(result.out, "{\"hit\":true}\n{\"hit\":false}\n{\"hit\":false}\n");
}

TEST_F(CliQuery, LightsAreSampledAndTheirDensityIsKnown) {
  auto a = answers(R"({"p": [0, 5, 0], "n": [0, 1, 0], "u": [0.25, 0.75]}
{"p": [0, 5, 0], "u": [0.25, 0.75], "choice": 0.99}
{"p": [0, 5, 0], "d": [0, 3, 0]}
{"p": [0, 5, 0], "d": [1, 0, 0], "light": 0}
)",
                   {"--lights", "--kernel", "reference"});
  ASSERT_EQ(a.size(), 4U);
  for (const int i : {0, 1}) {
    ASSERT_EQ(a[static_cast<std::size_t>(i)]["lights"].size(), 1U);
    const json& light = a[static_cast<std::size_t>(i)]["lights"][0];
    EXPECT_EQ(light["valid"], true);
    EXPECT_EQ(light["object"], "lamp");
    EXPECT_EQ(light["selection"], 1.0);
    EXPECT_EQ(light["radiance"], json({3.0, 2.0, 1.0}));
    EXPECT_EQ(light["n"][1], -1.0);
    const double cosine = light["d"][1].get<double>();
    EXPECT_NEAR(light["distance"].get<double>(), 3 / cosine, 1e-12);
    if (i == 0) {
      EXPECT_NEAR(light["cosine"].get<double>(), cosine, 1e-15);
    }
    // The solid angle of a square, corner by corner.
    const double solid = 4 * std::atan(1.0 / (3 * std::sqrt(3.0 * 3 + 2)));
    EXPECT_NEAR(light["pdf"].get<double>() * solid, 1, 1e-9);
  }
  const json& seen = a[2]["lights"][0];
  EXPECT_EQ(seen["distance"], 3.0);
  EXPECT_EQ(seen["pdf"], a[0]["lights"][0]["pdf"]);
  EXPECT_EQ(a[3]["lights"][0]["valid"], false);
}

TEST_F(CliQuery, MaterialsAreEvaluatedAndSampled) {
  const auto a = answers(R"({"material": "grey", "wi": [0, 0, 1], "wo": [0, 3, 4]}
{"material": "grey", "wi": [0, 0, 1], "u": [0.5, 0.5]}
{"material": "silver", "n": [0, 1, 0], "wi": [3, 4, 0], "u": [0, 0]}
{"material": "glass", "wi": [0, 0, 1], "u": [0.5, 0]}
)",
                         {"--bsdf", "--kernel", "reference"});
  ASSERT_EQ(a.size(), 4U);
  constexpr double kPi = 3.14159265358979323846;
  expect_near(a[0]["value"], {0.5 * 0.8 / kPi, 0.25 * 0.8 / kPi, 0.8 / kPi}, 1e-15);
  EXPECT_NEAR(a[0]["pdf"].get<double>(), 0.8 / kPi, 1e-15);
  EXPECT_EQ(a[1]["delta"], false);
  expect_near(a[1]["weight"], {0.5, 0.25, 1});
  EXPECT_NEAR(a[1]["pdf"].get<double>(), a[1]["wo"][2].get<double>() / kPi, 1e-14);
  EXPECT_EQ(a[2]["delta"], true);
  EXPECT_EQ(a[2]["pdf"], 0.0);
  expect_near(a[2]["wo"], {-0.6, 0.8, 0}, 1e-15);
  expect_near(a[3]["wo"], {0, 0, -1}, 1e-15);
}

TEST_F(CliQuery, BadLinesAreNamedAndEarlierOnesAnswered) {
  struct Bad {
    const char* line;
    const char* flag;
    const char* says;
  };
  const Bad cases[] = {
      {"[1]", "", "in.jsonl line 3: expected a JSON object"},
      {"{\"o\": [0,0,0]", "", "in.jsonl line 3: not JSON"},
      {R"({"d": [0,0,1]})", "", R"(line 3: "o": expected [x, y, z])"},
      {R"({"o": [0,0], "d": [0,0,1]})", "", R"(line 3: "o": expected [x, y, z])"},
      {R"({"o": [0,0,"1"], "d": [0,0,1]})", "", R"(line 3: "o": expected [x, y, z])"},
      {R"({"o": [0,0,0], "d": [0,0,0]})", "", R"(line 3: "d": expected a direction)"},
      {R"({"o": [0,0,0], "d": [0,0,1], "tmx": 3})", "",
       R"(line 3: "tmx": unknown field, did you mean "tmax")"},
      {R"({"o": [0,0,0], "d": [0,0,1], "tmin": -1})", "", R"("tmin": expected)"},
      {R"({"o": [0,0,0], "d": [0,0,1], "time": 2})", "", R"("time": expected)"},
      {R"({"o": [0,0,0], "d": [0,0,1], "from": {"object": "bal"}})", "",
       R"("from": "object": expected the name of an object; there is no 'bal', did you mean "ball")"},
      {R"({"o": [0,0,0], "d": [0,0,1], "from": {"object": "tiles", "triangle": 2}})", "",
       R"("from": "triangle": expected a whole number from 0 to 1)"},
      {R"({"p": [0,0,0], "u": [0, 1]})", "--lights", R"("u": expected 2 numbers)"},
      {R"({"p": [0,0,0], "u": [0, 0], "light": 1})", "--lights", R"("light": expected)"},
      {R"({"material": "gray", "wi": [0,0,1], "u": [0,0]})", "--bsdf",
       R"(there is no 'gray', did you mean "grey")"},
      {R"({"material": "pewter", "wi": [0,0,1], "u": [0,0]})", "--bsdf",
       R"("u": expected 3 numbers)"},
  };
  for (const Bad& bad : cases) {
    const std::string flag = bad.flag;
    const std::string good = flag == "--lights" ? R"({"p": [0,0,0], "u": [0,0]})"
                             : flag == "--bsdf"
                                 ? R"({"material": "grey", "wi": [0,0,1], "u": [0,0]})"
                                 : R"({"o": [0,0,9], "d": [0,0,1]})";
    const ProgramResult result =
        run(good + "\n\n" + bad.line + "\n" + good,
            flag.empty() ? std::vector<std::string>{} : std::vector<std::string>{flag});
    EXPECT_EQ(result.exit_code, 3) << bad.line;
    EXPECT_NE(result.err.find(bad.says), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  }
  EXPECT_EQ(run("", {"--any", "--bsdf"}).exit_code, 2);
  EXPECT_EQ(run("", {"--input", "none.jsonl"}).exit_code, 2);  // twice
  const ProgramResult missing =
      run_lightbench(folder.path(), {"query", "s.json", "--input", "none.jsonl"});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_NE(missing.err.find("none.jsonl"), std::string::npos);
}

TEST_F(CliQuery, ManyLinesAreAnsweredInOrder) {
  std::string lines;
  for (int i = 0; i < 10000; ++i) {
    lines += "{\"o\": [" + std::to_string(i % 7) + ", 0, 10], \"d\": [0, 0, -1]}\n";
  }
  const auto a = answers(lines);
  ASSERT_EQ(a.size(), 10000U);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_EQ(a[i]["hit"], i % 7 < 2);
}

// A program on the other end of a pipe reads the answer before it asks on.
TEST_F(CliQuery, APipeGetsItsAnswerAtOnce) {
  int to[2], from[2];
  ASSERT_EQ(pipe(to), 0);
  ASSERT_EQ(pipe(from), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
    if (chdir(folder.path().c_str()) != 0) _exit(127);
    execl(LIGHTBENCH_EXE, "lightbench", "query", "s.json", "--any", nullptr);
    _exit(127);
  }
  close(to[0]);
  close(from[1]);
  FILE* out = fdopen(from[0], "r");
  for (int i = 0; i < 3; ++i) {
    const std::string question = "{\"o\": [0, 0, 10], \"d\": [0, 0, -1]}\n";
    ASSERT_EQ(write(to[1], question.data(), question.size()),
              static_cast<ssize_t>(question.size()));
    char answer[64] = {};
    ASSERT_NE(std::fgets(answer, sizeof answer, out), nullptr);
    EXPECT_STREQ(answer, "{\"hit\":true}\n");
  }
  close(to[1]);
  EXPECT_EQ(std::fgetc(out), EOF);
  std::fclose(out);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace lightbench
