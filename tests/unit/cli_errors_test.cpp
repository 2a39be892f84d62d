// Bad input of every kind: one clear line, the right exit code, nothing overwritten.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/program.h"

namespace lightbench {
namespace {

constexpr const char* kScene = R"({"lightbench": 1,
  "render": {"resolution": [8, 6], "spp": 2, "snapshots": [1]},
  "environment": {"type": "constant", "color": [1, 1, 1]},
  "materials": [{"name": "grey", "type": "lambertian"}],
  "objects": [{"name": "ball", "type": "sphere", "material": "grey"}]})";

struct BadInput {
  const char* name;
  std::vector<std::string> arguments;
  int exit_code;
  const char* says;  ///< part of the line on standard error
  const char* scene = kScene;
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

class CliErrors : public testing::TestWithParam<BadInput> {};

TEST_P(CliErrors, OneLineRightCodeNothingTouched) {
  const BadInput& input = GetParam();
  const TemporaryFolder folder;
  write_text(folder.path() / "s.json", input.scene);
  write_text(folder.path() / "old.png", "precious");
  write_text(folder.path() / "not-a-folder", "");
  const auto before = folder.names();
  const ProgramResult result = run_lightbench(folder.path(), input.arguments);
  EXPECT_EQ(result.exit_code, input.exit_code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.rfind("lightbench: ", 0), 0U) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_NE(result.err.find(input.says), std::string::npos) << result.err;
  EXPECT_EQ(read_text(folder.path() / "old.png"), "precious");
  EXPECT_EQ(folder.names(), before);
}

std::vector<std::string> render(std::vector<std::string> more) {
  std::vector<std::string> arguments{"render", "s.json", "-o", "old.png"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

const BadInput kFlags[] = {
    {"UnknownCommand", {"rendr", "s.json"}, 2, "did you mean \"render\""},
    {"UnknownOption", render({"--sppp", "3"}), 2, "'--sppp', did you mean \"--spp\""},
    {"UnknownOptionFarFromAll", render({"--xyzzy"}), 2, "unknown option '--xyzzy'"},
    {"ExtraArgument", render({"more.json"}), 2, "unexpected argument 'more.json'"},
    {"NoScene", {"render"}, 2, "SCENE"},
    {"OptionWithoutValue", render({"--spp"}), 2, "--spp"},
    {"SppWord", render({"--spp", "many"}), 2, "--spp 'many'"},
    {"SppNegative", render({"--spp", "-3"}), 2, "--spp '-3'"},
    {"SppHuge", render({"--spp", "99999999999"}), 2, "--spp '99999999999'"},
    {"SppTrailingComma", render({"--spp", "1,"}), 2, "--spp '1,'"},
    {"SppWithoutLimit", render({"--spp", "0"}), 2, "expected --spp N or --time-limit"},
    {"SeveralCountsOneName", render({"--spp", "1,2"}), 2, "need {spp}"},
    {"SameNameTwice", render({"-o", "./old.png"}), 2, "the same file"},
    {"UnknownField", {"render", "s.json", "-o", "{frame}.png"}, 2, "unknown field {frame}"},
    {"LoneBrace", {"render", "s.json", "-o", "{spp.png"}, 2, "a single '{'"},
    {"UnknownFormat", {"render", "s.json", "-o", "x.gif"}, 2, ".png"},
    {"NoExtension", {"render", "s.json", "-o", "x"}, 2, ".png"},
    {"Threads", render({"--threads", "two"}), 2, "--threads 'two'"},
    {"ThreadsAbsurd", render({"--threads", "1000000"}), 2, "--threads '1000000'"},
    {"ResolutionWord", render({"--resolution", "big"}), 2, "--resolution 'big'"},
    {"ResolutionZero", render({"--resolution", "0x5"}), 2, "--resolution '0x5'"},
    {"ResolutionAbsurd", render({"--resolution", "9999999x9999999"}), 2, "--resolution"},
    {"CropOutside", render({"--crop", "4,4,8,8"}), 2, "--crop '4,4,8,8'"},
    {"CropShort", render({"--crop", "1,2,3"}), 2, "--crop '1,2,3'"},
    {"CropEmpty", render({"--crop", "1,1,0,2"}), 2, "--crop '1,1,0,2'"},
    {"Depth", render({"--depth", "0"}), 2, "--depth '0'"},
    {"Seed", render({"--seed", "-1"}), 2, "--seed '-1'"},
    {"SeedTooLarge", render({"--seed", "4294967296"}), 2, "--seed '4294967296'"},
    {"Exposure", render({"--exposure", "nan"}), 2, "--exposure 'nan'"},
    {"TimeLimit", render({"--time-limit", "soon"}), 2, "--time-limit 'soon'"},
    {"TimeLimitZero", render({"--time-limit", "0s"}), 2, "--time-limit '0s'"},
    {"Kernel", render({"--kernel", "gpu"}), 2, "--kernel 'gpu'"},
    {"Progress", render({"--progress", "loud"}), 2, "--progress 'loud'"},
    {"DefinitionWithoutPointer", render({"-D", "spp=3"}), 2, "-D 'spp=3'"},
    {"DefinitionUnknownKey", render({"-D", "/render/sppp=3"}), 3, "sppp"},
    {"DefinitionOutOfRange", render({"-D", "/render/maxDepth=-1"}), 3, "/render/maxDepth"},
    {"Gate", {"compare", "old.png", "old.png", "--max-relmse", "-1"}, 2, "--max-relmse"},
};

const BadInput kFiles[] = {
    {"MissingScene", {"render", "none.json", "-o", "old.png"}, 3, "none.json"},
    {"SceneIsAFolder", {"render", ".", "-o", "old.png"}, 3, "."},
    {"SceneOfOtherProgram", render({}), 3, "s.json", "PNG\r\n\x1a"},
    {"EmptyScene", render({}), 3, "s.json", ""},
    {"BrokenJson", render({}), 3, "s.json", R"({"lightbench": 1, "objects": [})"},
    {"UnknownKey", render({}), 3, "/render", R"({"lightbench": 1, "render": {"sp": 3}})"},
    {"NegativeRadius", render({}), 3, "/objects/0/radius",
     R"({"lightbench": 1, "objects": [{"name": "a", "type": "sphere", "radius": -1}]})"},
    {"MissingTexture", render({}), 3, "no-such.png",
     R"({"lightbench": 1, "textures": [{"name": "t", "type": "image", "file": "no-such.png"}]})"},
    {"MissingMesh", render({}), 3, "no-such.ply",
     R"({"lightbench": 1, "meshes": [{"name": "m", "file": "no-such.ply"}]})"},
    {"InfoOfBrokenScene", {"info", "s.json"}, 3, "s.json", "{"},
    {"OutputBelowAFile", {"render", "s.json", "-o", "not-a-folder/x.png"}, 4, "not-a-folder"},
    {"StatsBelowAFile", render({"--stats-json", "not-a-folder/s.json"}), 4, "not-a-folder"},
    {"CompareMissing", {"compare", "none.png", "old.png"}, 3, "none.png"},
    {"CompareNotAnImage", {"compare", "old.png", "old.png"}, 3, "old.png"},
};

std::string name_of(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Flags, CliErrors, testing::ValuesIn(kFlags), name_of);
INSTANTIATE_TEST_SUITE_P(Files, CliErrors, testing::ValuesIn(kFiles), name_of);

}  // namespace
}  // namespace lightbench
