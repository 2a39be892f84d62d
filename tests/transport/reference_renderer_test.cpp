// scenes/cornell-plain.json against the same scene rendered by another program (its block means and
// their errors are in data/, with their provenance), and proof that this comparison would notice.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/exponential.hpp>
#include <sstream>

#include "core/scene/scene_io.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

constexpr std::size_t kBlocks = 10, kBlockSize = 30, kPixels = kBlocks * kBlockSize;
constexpr double kBlockArea = kBlockSize * kBlockSize;
constexpr int kSeeds = 16;

using BlockMeans = std::vector<glm::dvec3>;

struct Reference {
  BlockMeans mean, error;
};

Reference read_reference() {
  std::ifstream file(LIGHTBENCH_SOURCE_DIR "/tests/transport/data/cornell-plain-blocks.csv");
  Reference r;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#' || line.front() == 'b') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream in(line);
    int x, y;
    glm::dvec3 mean, error;
    in >> x >> y >> mean.x >> mean.y >> mean.z >> error.x >> error.y >> error.z;
    EXPECT_FALSE(in.fail()) << line;
    r.mean.push_back(mean);
    r.error.push_back(error);
  }
  return r;
}

/// One list of block means per seed; lights scaled by `brightness`.
std::vector<BlockMeans> render_blocks(KernelKind kernel, int spp, double brightness) {
  Scene s = load_scene(LIGHTBENCH_SOURCE_DIR "/scenes/cornell-plain.json");
  EXPECT_EQ(s.render.width, static_cast<int>(kPixels));
  EXPECT_EQ(s.render.height, static_cast<int>(kPixels));
  for (Material& m : s.materials) m.emissive *= brightness;
  std::vector<BlockMeans> result;
  for (int seed = 0; seed < kSeeds; ++seed) {
    s.render.seed = static_cast<std::uint32_t>(seed);
    const Film film = render_film(s, kernel, spp);
    BlockMeans blocks(kBlocks * kBlocks, glm::dvec3(0));
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
      const std::size_t x = i % kPixels, y = i / kPixels;
      blocks[y / kBlockSize * kBlocks + x / kBlockSize] += pixel_mean(film, i, spp) / kBlockArea;
    }
    result.push_back(blocks);
  }
  return result;
}

/// Adds the other program's error to ours; degrees of freedom after Welch and Satterthwaite, where
/// the reference's many samples count as infinitely many.
Estimate with_reference_error(Estimate ours, const glm::dvec3& error) {
  double freedom = 1e6;
  for (int k = 0; k < 3; ++k) {
    const double a = ours.error[k] * ours.error[k], b = error[k] * error[k];
    if (a > 0) freedom = std::min(freedom, ours.freedom * (a + b) * (a + b) / (a * a));
    ours.error[k] = std::sqrt(a + b);
  }
  ours.freedom = freedom;
  return ours;
}

struct Comparison {
  Family blocks{0.03, 0, 0.02}, picture{5e-4, 0};
};

Comparison compare(const std::vector<BlockMeans>& ours, const Reference& reference) {
  Comparison c;
  std::vector<glm::dvec3> pictures(ours.size(), glm::dvec3(0));
  glm::dvec3 reference_mean(0), reference_variance(0);
  const auto count = static_cast<double>(reference.mean.size());
  for (std::size_t b = 0; b < reference.mean.size(); ++b) {
    std::vector<glm::dvec3> seeds;
    for (std::size_t s = 0; s < ours.size(); ++s) {
      seeds.push_back(ours[s][b]);
      pictures[s] += ours[s][b] / count;
    }
    c.blocks.add("block " + std::to_string(b % kBlocks) + "," + std::to_string(b / kBlocks),
                 reference.mean[b], with_reference_error(summarize(seeds), reference.error[b]));
    reference_mean += reference.mean[b] / count;
    reference_variance += reference.error[b] * reference.error[b] / (count * count);
  }
  c.picture.add("whole picture", reference_mean,
                with_reference_error(summarize(pictures), glm::sqrt(reference_variance)));
  return c;
}

TEST(ReferenceRenderer, AgreesOnTheHeadlineScene) {
  const Reference reference = read_reference();
  ASSERT_EQ(reference.mean.size(), kBlocks * kBlocks);
  const Comparison c = compare(render_blocks(KernelKind::Auto, 8, 1), reference);
  c.blocks.expect_agreement();
  c.picture.expect_agreement();
}

// Half a percent of emission too much must not pass.
TEST(ReferenceRenderer, NoticesHalfAPercentOfBias) {
  const Reference reference = read_reference();
  const Comparison c = compare(render_blocks(KernelKind::Auto, 8, 1.005), reference);
  EXPECT_EQ(c.picture.disagreements().size(), 3U) << "each channel";
}

}  // namespace
}  // namespace lightbench
