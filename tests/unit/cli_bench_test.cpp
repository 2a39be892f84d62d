// lightbench bench: references, the figures of a small scene, comparisons, and what is refused.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/film/image_file.h"
#include "tests/unit/program.h"

namespace lightbench {
namespace {

using Json = nlohmann::json;

// A lit floor: noise of a light that is sampled, and of nothing else.
constexpr const char* kScene = R"({"lightbench": 1,
  "camera": {"lookFrom": [0, 3, 6], "lookAt": [0, 0, 0]},
  "render": {"resolution": [12, 8], "maxDepth": 3},
  "materials": [{"name": "grey", "type": "lambertian", "baseColor": [0.5, 0.5, 0.5]},
                {"name": "glow", "type": "emissive", "emissive": [3, 2, 1]}],
  "objects": [{"name": "floor", "type": "rectangle", "corner": [-4, 0, 4], "edgeU": [8, 0, 0],
               "edgeV": [0, 0, -8], "material": "grey"},
              {"name": "lamp", "type": "sphere", "center": [0, 2, 0], "radius": 0.5, "material": "glow"}]})";

struct CliBench : testing::Test {
  TemporaryFolder folder;
  void SetUp() override { write_text(folder.path() / "s.json", kScene); }

  ProgramResult bench(std::vector<std::string> more) {
    std::vector<std::string> arguments{"bench", "s.json", "--references", "refs", "-t", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lightbench(folder.path(), arguments);
  }
  void make_reference() {
    const ProgramResult r = bench({"--make-references", "--reference-error", "1e-5"});
    ASSERT_EQ(r.exit_code, 0) << r.err;
  }
  Json figures(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"--json", "f.json", "--time", "0.3s"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult r = bench(arguments);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return Json::parse(read_text(folder.path() / "f.json"))["scenes"][0];
  }
};

TEST_F(CliBench, AReferenceSaysWhatItIs) {
  make_reference();
  const auto file = folder.path() / "refs/s.exr";
  const ImageMetadata header = read_image_metadata(file);
  EXPECT_EQ(header.at("Scene"), "s.json");
  EXPECT_EQ(header.at("pictureHash").size(), 16U);
  EXPECT_GE(std::stoi(header.at("samplesPerPixel")), 8 * 256);
  const double relmse = std::stod(header.at("relMSE"));
  EXPECT_GT(relmse, 0);
  EXPECT_LE(relmse, 1e-5);
  EXPECT_EQ(read_image(file).width, 12);
}

// A scene that changes leaves its reference behind: bench refuses it.
TEST(StoredReferences, AreOfTheStoredScenes) {
  const ProgramResult r =
      run_lightbench(LIGHTBENCH_SOURCE_DIR, {"bench", "--time", "0.1s", "-t", "1"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  int references = 0, judged = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(LIGHTBENCH_SOURCE_DIR "/scenes/references")) {
    references += entry.path().extension() == ".exr" ? 1 : 0;
  }
  for (std::size_t at = 0; (at = r.out.find("bias", at)) != std::string::npos; ++at) ++judged;
  EXPECT_GT(references, 0);
  EXPECT_EQ(judged, references);
}

TEST_F(CliBench, TheErrorFallsAndTheMeanIsRight) {
  make_reference();
  const Json scene = figures({});
  ASSERT_EQ(scene["subjects"].size(), 1U);
  const Json& s = scene["subjects"][0];
  EXPECT_GE(s["runs"].get<int>(), 8);
  const Json& curve = s["curve"];
  ASSERT_GE(curve.size(), 3U);
  for (std::size_t k = 0; k < curve.size(); ++k) EXPECT_EQ(curve[k]["spp"].get<double>(), 1 << k);
  EXPECT_LT(curve.back()["relMSE"].get<double>(), 0.3 * curve[0]["relMSE"].get<double>());
  EXPECT_GT(curve.back()["seconds"].get<double>(), curve[0]["seconds"].get<double>());
  const double efficiency = s["efficiency"][0].get<double>();
  EXPECT_NEAR(
      efficiency * curve.back()["relMSE"].get<double>() * curve.back()["seconds"].get<double>(), 1,
      1e-6);
  EXPECT_LE(s["efficiency"][1].get<double>(), efficiency);
  EXPECT_GE(s["efficiency"][2].get<double>(), efficiency);
  // Half a percent would be a fault.
  EXPECT_LT(std::abs(s["relativeBias"][0].get<double>()), 5e-3);
  EXPECT_EQ(s["nonFiniteSamples"].get<int>(), 0);
}

TEST_F(CliBench, FindsTheBetterOfTwoSettings) {
  make_reference();
  // The lamp is small: paths rarely meet it by themselves.
  const auto ratio = [&](const std::string& ab) {
    const Json scene = figures({"--ab", "/render/strategy=" + ab});
    EXPECT_EQ(scene["subjects"].size(), 2U);
    return scene["subjects"][1]["againstFirst"]["efficiencyRatio"];
  };
  const Json better = ratio("bsdf,mis"), worse = ratio("mis,bsdf");
  EXPECT_GT(better[1].get<double>(), 2) << better;
  EXPECT_LT(worse[2].get<double>(), 0.5) << worse;
}

TEST_F(CliBench, VariesSeveralSettingsAtOnce) {
  make_reference();
  const Json subjects = figures({"--ab", "/render/sampler=independent,sobol", "--ab",
                                 "/render/strategy=bsdf,mis"})["subjects"];
  ASSERT_EQ(subjects.size(), 2U);
  EXPECT_EQ(subjects[0]["name"], "/render/sampler=independent /render/strategy=bsdf");
  EXPECT_EQ(subjects[1]["name"], "/render/sampler=sobol /render/strategy=mis");
  EXPECT_GT(subjects[1]["againstFirst"]["efficiencyRatio"][1].get<double>(), 2);
  const ProgramResult r =
      bench({"--ab", "/render/sampler=independent,sobol", "--ab", "threads=1,1,1"});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_NE(r.err.find("expected 2 values"), std::string::npos) << r.err;
}

TEST_F(CliBench, AReferenceKeepsWhatHalfCannot) {
  make_reference();
  const auto file = folder.path() / "refs/s.exr";
  Image image = read_image(file);
  image.rgb[0] = 1e6F + 1;
  write_image(file, image, {}, read_image_metadata(file), {}, ExrNumbers::Float);
  EXPECT_EQ(read_image(file).rgb, image.rgb);
}

TEST_F(CliBench, ThePageHoldsEverything) {
  make_reference();
  ASSERT_EQ(bench({"--time", "0.1s", "--html", "p.html"}).exit_code, 0);
  const std::string page = read_text(folder.path() / "p.html");
  EXPECT_NE(page.find("Chart.js v"), std::string::npos);
  EXPECT_NE(page.find("\"curve\""), std::string::npos);
  EXPECT_EQ(page.find("/*DATA*/"), std::string::npos);
  EXPECT_EQ(page.find("/*CHART_JS*/"), std::string::npos);
  EXPECT_EQ(page.find("src=\""), std::string::npos) << "a file beside the page";
  EXPECT_EQ(page.find("href=\""), std::string::npos) << "a file beside the page";
}

TEST_F(CliBench, RefusesWhatDoesNotFit) {
  const ProgramResult none = bench({});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_NE(none.err.find("--make-references"), std::string::npos) << none.err;
  make_reference();
  for (const char* change : {"/objects/1/radius=0.6", "/materials/0/baseColor=[0.5,0.5,0.4]",
                             "/render/resolution=[16,8]", "/render/maxDepth=4"}) {
    const ProgramResult r = bench({"-D", change});
    EXPECT_EQ(r.exit_code, 3) << change;
    EXPECT_NE(r.err.find("reference of another picture"), std::string::npos) << r.err;
  }
  // What only changes the noise or the display is the same picture.
  EXPECT_EQ(
      bench({"--time", "0.05s", "-D", "/render/rouletteDepth=1", "--exposure", "1"}).exit_code, 0);
  EXPECT_EQ(bench({"--seed", "4"}).exit_code, 2);
  EXPECT_EQ(bench({"--adaptive"}).exit_code, 2);
  EXPECT_EQ(bench({"--ab", "kernel=scalar,avx2", "--kernels", "scalar"}).exit_code, 2);
  for (const char* bad : {"kernel=scalar", "nonsense=1,2", "kernel=scalar,fast"}) {
    const ProgramResult r = bench({"--ab", bad});
    EXPECT_EQ(r.exit_code, 2) << bad;
    EXPECT_NE(r.err.find("--ab"), std::string::npos) << r.err;
  }
  write_text(folder.path() / "refs/s.exr", "not an image");
  EXPECT_EQ(bench({}).exit_code, 3);
}

}  // namespace
}  // namespace lightbench
