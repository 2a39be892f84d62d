// One room rendered in many ways, which must agree: sampling strategies, roulette and precision
// against each other by Welch's test, and the same world in other units and places.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/proof/build_scene.h"
#include "app/proof/compare_pictures.h"
#include "app/proof/measure.h"
#include "app/proof/same_world.h"
#include "app/stress/pictures.h"
#include "app/stress/random_room.h"

namespace lightbench::stress {
using namespace proof;
namespace {

constexpr int kSize = 48, kSeeds = 8;

struct Way {
  std::string name;
  Scene scene;
  KernelKind kernel;
  bool left_is_right = false;
};

const char* const kTileMeasure = "-log10 of the p-value that the tiles' p-values are uniform";
const char* const kStillMeasure = "largest relative difference";
/// A tile without noise may have a standard error of up to kStill.
constexpr double kStillLimit = kLargestDeviate * kStill;

std::vector<TiledPicture> pictures_of(Random& random, const std::vector<Way>& ways, int spp) {
  std::vector<TiledPicture> pictures;
  auto seed = static_cast<std::uint32_t>(random.unit() * 0x1p31);
  for (const Way& way : ways) {
    TiledPicture picture = measure_tiles(way.scene, way.kernel, spp, kSeeds, seed);
    pictures.push_back(way.left_is_right ? mirrored(std::move(picture)) : std::move(picture));
    seed += kSeeds;
  }
  return pictures;
}

/// All pairs of ways, into the tallies `whole`, `tiles` and `still`.
void compare_all(Random& random, const std::string& room, const std::vector<Way>& ways, int spp,
                 Tally& whole, Tally& tiles, Tally& still) {
  const auto pictures = pictures_of(random, ways, spp);
  for (std::size_t a = 0; a < ways.size(); ++a) {
    for (std::size_t b = a + 1; b < ways.size(); ++b) {
      const PictureComparison c = compare_pictures(pictures[a], pictures[b]);
      const double z = std::abs(equivalent_z(c.whole.t, c.whole.freedom));
      const double p = uniformity(c.p);
      const auto text = [&] {
        return fmt::format("{}: {} against {}, z {:.3g}, KS p {:.3g}, still tiles {:.3g}", room,
                           ways[a].name, ways[b].name, z, p, c.still);
      };
      whole.trial();
      whole.measure(z, text);
      tiles.trial();
      tiles.measure(-std::log10(std::max(p, 1e-300)), text);
      still.trial();
      still.measure(c.still, text);
    }
  }
}

/// The same ways, with everything aglow and nothing but that seen: most tiles are without noise.
void compare_glow(Random& random, const std::string& room, std::vector<Way> ways, Tally& still) {
  for (Way& way : ways) {
    for (Material& m : way.scene.materials) {
      const std::string name = m.name;
      m = light(m.kind == MaterialKind::Emissive ? m.emissive : glm::dvec3(0.5), true);
      m.name = name;
    }
    way.scene.media.clear();
    std::erase_if(way.scene.objects, [](const Object& o) { return o.material == kNone; });
    way.scene.render.max_depth = way.scene.render.roulette_depth = 1;
  }
  const auto pictures = pictures_of(random, ways, 4);
  for (std::size_t a = 0; a < ways.size(); ++a) {
    for (std::size_t b = a + 1; b < ways.size(); ++b) {
      const PictureComparison c = compare_pictures(pictures[a], pictures[b]);
      still.trial();
      still.measure(c.still, [&] {
        return fmt::format("{}: {} against {}, aglow: {:.3g}", room, ways[a].name, ways[b].name,
                           c.still);
      });
    }
  }
}

std::vector<Way> strategies(const Scene& room, KernelKind kernel) {
  std::vector<Way> ways;
  const auto add = [&](const char* name, Strategy strategy, bool roulette, KernelKind with) {
    Scene scene = room;
    scene.render.strategy = strategy;
    if (!roulette) scene.render.roulette_depth = scene.render.max_depth;
    ways.push_back({name, std::move(scene), with, false});
  };
  add("both", Strategy::Mis, true, kernel);
  add("lights", Strategy::Lights, true, kernel);
  add("BSDF", Strategy::Bsdf, true, kernel);
  add("both, no roulette", Strategy::Mis, false, kernel);
  add("lights, no roulette", Strategy::Lights, false, kernel);
  add("BSDF, no roulette", Strategy::Bsdf, false, kernel);
  const KernelKind other = kernel == KernelKind::Auto || precision_of(kernel) == Precision::Float
                               ? best_kernel(Precision::Double)
                               : best_kernel(Precision::Float);
  add("both, other precision", Strategy::Mis, true, other);
  return ways;
}

Scene with_seed(Scene scene, std::uint32_t seed) {
  scene.render.seed = seed;
  return scene;
}

/// The same seed in other units and places; then the same world turned and mirrored.
void other_words(Random& random, KernelKind kernel, std::span<Tally> tallies) {
  const Scene room =
      with_seed(random_room(random, kSize), static_cast<std::uint32_t>(random.unit() * 0x1p31));
  constexpr int kSameSeedSpp = 32;
  constexpr double kRoomSize = 6;
  const Film plain = render_film(room, kernel, kSameSeedSpp);
  struct Words {
    std::string name;
    Scene scene;
  };
  std::vector<Words> words;
  for (const double scale : {1e-4, 1e4}) {
    words.push_back({fmt::format("units {:g}", scale), in_other_units(room, scale, glm::dvec3(0))});
  }
  for (const double sizes : {1e5, 1e7}) {
    const glm::dvec3 shift = kRoomSize * sizes * random.direction();
    words.push_back({fmt::format("{:g} sizes away", sizes), in_other_units(room, 1, shift)});
  }
  for (const Words& w : words) {
    const PictureDifference d =
        picture_difference(plain, render_film(w.scene, kernel, kSameSeedSpp), kSameSeedSpp);
    tallies[0].trial();
    tallies[0].measure(d.relative_mae, [&] {
      return fmt::format("{}: {}, relMAE {:.3g}", describe_room(room), w.name, d.relative_mae);
    });
  }
  const std::vector<Way> ways{{"plain", room, kernel, false},
                              {"turned", turned_world(room, random.direction(), 37), kernel, false},
                              {"mirrored", mirrored_world(room), kernel, true}};
  compare_all(random, describe_room(room), ways, 8, tallies[1], tallies[2], tallies[3]);
  compare_glow(random, describe_room(room), ways, tallies[3]);
}

}  // namespace

void add_picture_pair_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"strategies",
       "rooms of random shapes and materials: light sampling, BSDF sampling and both, with and "
       "without roulette, and the other precision; all 21 pairs, Welch's test",
       {{"strategies, whole picture", "difference in standard errors", kLargestDeviate,
         kLargestDeviate, 0},
        {"strategies, tiles", kTileMeasure, kLargestDeviate, kLargestDeviate, 0},
        {"strategies, tiles without noise", kStillMeasure, kStillLimit, kStillLimit, 0}},
       1,
       150,
       1,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const Scene room = random_room(random, kSize);
             const std::vector<Way> ways = strategies(room, kernel);
             compare_all(random, describe_room(room), ways, 24, tallies[0], tallies[1], tallies[2]);
             compare_glow(random, describe_room(room), ways, tallies[2]);
           }
         };
       }});
  tests.push_back(
      {"same world in other words",
       "such rooms in units of 1e-4 and 1e4, 1e5 and 1e7 sizes away, turned by 37 degrees about "
       "any axis, mirrored",
       {{"other words, same seed", "mean absolute difference over the mean", 1e-5, 1e-5, 0},
        {"other words, whole picture", "difference in standard errors", kLargestDeviate,
         kLargestDeviate, 0},
        {"other words, tiles", kTileMeasure, kLargestDeviate, kLargestDeviate, 0},
        {"other words, tiles without noise", kStillMeasure, kStillLimit, kStillLimit, 0}},
       2,
       500,
       1,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) other_words(random, kernel, tallies);
         };
       }});
}

}  // namespace lightbench::stress
