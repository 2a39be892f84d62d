// Every way of sampling against every other, on every small scene: light sampling, BSDF sampling
// and both; with Russian roulette and without; float and double kernels; any number of threads.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/proof/compare_pictures.h"
#include "app/proof/measure.h"
#include "core/scene/scene_io.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

namespace fs = std::filesystem;
const fs::path kScenes = fs::path(LIGHTBENCH_SOURCE_DIR) / "scenes";
constexpr int kSide = 48;

struct Named {
  std::string name;
  Scene scene;
};

/// Of scenes/features all, and the books' with few objects; 3 x 3 tiles.
std::vector<Named> small_scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(kScenes / "features")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  for (const char* book : {"checkered-spheres", "cornell-box", "cornell-plain", "cornell-smoke",
                           "cornell-three-lights", "earth", "perlin-spheres", "quads",
                           "rest-of-life-final", "simple-light"}) {
    files.push_back(kScenes / (std::string(book) + ".json"));
  }
  std::sort(files.begin(), files.end());
  std::vector<Named> scenes;
  for (const fs::path& file : files) {
    scenes.push_back({file.stem().string(), load_scene(file)});
    RenderSettings& render = scenes.back().scene.render;
    render.width = render.height = kSide;
    render.crop = {};
  }
  return scenes;
}

struct Way {
  std::string name;
  Strategy strategy;
  bool roulette;
  Precision precision;
};

std::vector<Way> ways() {
  std::vector<Way> all;
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    for (const bool roulette : {true, false}) {
      if (precision == Precision::Double && !roulette) continue;
      for (const auto& [name, strategy] : {std::pair{"mis", Strategy::Mis},
                                           {"lights", Strategy::Lights},
                                           {"bsdf", Strategy::Bsdf}}) {
        all.push_back({fmt::format("{}{}{}", name, roulette ? "" : ", no roulette",
                                   precision == Precision::Float ? "" : ", double"),
                       strategy, roulette, precision});
      }
    }
  }
  return all;
}

Scene scene_for(Scene scene, const Way& way) {
  scene.render.strategy = way.strategy;
  if (!way.roulette) scene.render.roulette_depth = scene.render.max_depth;
  return scene;
}

TEST(Strategies, AllHaveTheSameMeanOnEverySmallScene) {
  constexpr int kSpp = 8, kSeeds = 12;
  const std::vector<Way> all = ways();
  std::vector<Named> scenes = small_scenes();
  if (kThinning > 1) scenes.erase(scenes.begin() + 4, scenes.end());
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> p_values;
  struct Whole {
    std::string name;
    double z;
  };
  std::vector<Whole> wholes;
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    std::vector<TiledPicture> pictures;
    for (std::size_t w = 0; w < all.size(); ++w) {
      // No two pictures share random numbers.
      const auto seed = static_cast<std::uint32_t>((s * all.size() + w) * kSeeds);
      pictures.push_back(measure_tiles(scene_for(scenes[s].scene, all[w]),
                                       best_kernel(all[w].precision), kSpp, kSeeds, seed));
    }
    for (std::size_t a = 0; a < all.size(); ++a) {
      for (std::size_t b = a + 1; b < all.size(); ++b) {
        const PictureComparison c = compare_pictures(pictures[a], pictures[b]);
        auto& p = p_values[{a, b}];
        p.insert(p.end(), c.p.begin(), c.p.end());
        const std::string name = scenes[s].name + ": " + all[a].name + " against " + all[b].name;
        wholes.push_back({name, equivalent_z(c.whole.t, c.whole.freedom)});
        EXPECT_LE(c.still, 2e-5) << name;
      }
    }
  }
  const double each = -std::expm1(std::log1p(-0.01) / static_cast<double>(p_values.size()));
  double least = 1;
  for (const auto& [pair, p] : p_values) {
    const double uniform = uniformity(p);
    least = std::min(least, uniform);
    fmt::print("{:<24} against {:<24} {:>4} tiles, KS p {:.3f}\n", all[pair.first].name,
               all[pair.second].name, p.size(), uniform);
    EXPECT_GT(uniform, each) << all[pair.first].name << " against " << all[pair.second].name;
  }
  const double limit = sidak_limit(0.01, wholes.size());
  double largest = 0;
  for (const Whole& w : wholes) {
    largest = std::max(largest, std::abs(w.z));
    EXPECT_LE(std::abs(w.z), limit) << w.name;
  }
  fmt::print(
      "{} scenes: least KS p {:.4f} of {} (limit {:.5f}); whole pictures |z| <= {:.2f} of {} "
      "(limit {:.2f})\n",
      scenes.size(), least, p_values.size(), each, largest, wholes.size(), limit);
}

// Half a percent of emission too much or too little in one of two pictures must not pass.
TEST(Strategies, APlantedErrorIsFound) {
  if (kThinning > 1) GTEST_SKIP() << "takes more samples than a watched kernel can";
  const Scene plain = [] {
    Scene s = load_scene(kScenes / "cornell-plain.json");
    s.render.width = s.render.height = kSide;
    return s;
  }();
  constexpr int kSpp = 64, kSeeds = 24;
  std::uint32_t seed = 0;
  const auto measure = [&](Strategy strategy, double emission) {
    Scene s = plain;
    s.render.strategy = strategy;
    for (Material& m : s.materials) m.emissive *= emission;
    seed += kSeeds;
    return measure_tiles(s, KernelKind::Auto, kSpp, kSeeds, seed);
  };
  const TiledPicture mis = measure(Strategy::Mis, 1), lights = measure(Strategy::Lights, 1);
  const auto deviate = [](const TiledPicture& a, const TiledPicture& b) {
    const Welch w = compare_pictures(a, b).whole;
    return std::abs(equivalent_z(w.t, w.freedom));
  };
  const double limit = sidak_limit(0.01, 3);
  EXPECT_LT(deviate(mis, lights), limit);
  EXPECT_GT(deviate(mis, measure(Strategy::Lights, 1.005)), limit);
  EXPECT_GT(deviate(mis, measure(Strategy::Lights, 0.995)), limit);
}

TEST(Strategies, ThreadsChangeNoBit) {
  for (const Named& named : small_scenes()) {
    for (const Strategy strategy : {Strategy::Mis, Strategy::Lights, Strategy::Bsdf}) {
      Scene scene = named.scene;
      scene.render.width = scene.render.height = 24;
      scene.render.strategy = strategy;
      const auto compiled = compile(scene, KernelKind::Auto);
      EXPECT_EQ(render_film(*compiled, 2).hash(), render_on_threads(*compiled, 2, 7).hash())
          << named.name;
    }
  }
}

}  // namespace
}  // namespace lightbench
