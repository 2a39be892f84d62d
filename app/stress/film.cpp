// A pixel that takes up to 1e9 samples.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

// Numbers of float, so that every kernel's sample is exactly this.
const glm::dvec3 kColor(0.7F, 0.7e-3F, 0.7e-6F);

/// Mixed magnitudes: constant environments of these radiances in turn, in one film whose unit is
/// that of the largest.
constexpr int kMagnitudes = 13;
double magnitude(int k) { return static_cast<double>(static_cast<float>(std::pow(10.0, k - 6))); }

std::vector<std::shared_ptr<const RenderScene>> mixed_scenes(KernelKind kernel) {
  std::vector<std::shared_ptr<const RenderScene>> scenes;
  for (int k = 0; k < kMagnitudes; ++k) {
    Scene scene = empty_scene();
    scene.environment.kind = EnvironmentKind::Constant;
    scene.environment.color = glm::dvec3(magnitude(k));
    // Behind the camera: seen by no ray, it gives all films the same unit.
    scene.materials[0].kind = MaterialKind::Emissive;
    scene.materials[0].emissive = glm::dvec3(magnitude(kMagnitudes - 1));
    add_object(scene, SphereShape{{0, 0, 50}, 1, glm::dvec3(0)});
    scenes.push_back(compile(scene, kernel));
  }
  return scenes;
}

/// Samples [first, last) of the pixel, magnitude by magnitude.
void render_mixed(std::span<const std::shared_ptr<const RenderScene>> scenes, std::uint64_t first,
                  std::uint64_t last, Film& film) {
  Counters counters;
  for (const auto& scene : scenes) {
    Work work{
        0, 0, 1, 1, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first), 1};
    render(*scene, work, film.view(), counters);
  }
}

void add_mixed(std::vector<Test>& tests) {
  tests.push_back(
      {"film of mixed magnitudes",
       "one pixel that takes radiances 1e-6, 1e-5, ... 1e6 equally often; once whole, and once in "
       "two films that are added",
       {{"film, drift of a mixed mean", "relative error", 1e-9, 1e-9},
        {"film, variance of a mixed pixel", "relative error", 1e-6, 1e-6},
        // Squares are kept to 2^-24 of the unit's.
        {"film, variance of equal samples", "variance / squared mean", 1e-9, 1e-9},
        {"film, sums of merged parts", "", kNoLimit, kNoLimit, 0}},
       2'000'000,
       1'000'000'000,
       1'000'000'000,
       [](KernelKind kernel) -> Chunk {
         const auto scenes = mixed_scenes(kernel);
         return [scenes](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           const std::uint64_t each = trials / kMagnitudes, n = each * kMagnitudes;
           Film whole(1, 1, scenes[0]->film_unit);
           render_mixed(scenes, 0, each, whole);
           Film first(1, 1, whole.unit()), second(1, 1, whole.unit());
           const auto cut = static_cast<std::uint64_t>(random.unit() * static_cast<double>(each));
           render_mixed(scenes, 0, cut, first);
           render_mixed(scenes, cut, each, second);
           long double mean = 0, square = 0;
           for (int k = 0; k < kMagnitudes; ++k) {
             const long double x = magnitude(k);
             mean += x / kMagnitudes;
             square += x * x / kMagnitudes;
           }
           const FilmPixel& sum = whole.pixels()[0];
           const FilmPixel &a = first.pixels()[0], &b = second.pixels()[0];
           const long double step = std::ldexp(whole.unit(), -kFilmBits);
           const long double got =
               step * static_cast<long double>(sum.r) / static_cast<long double>(n);
           const auto count = static_cast<long double>(n);
           const long double variance = (square - mean * mean) * count / (count - 1);
           const double found = whole.variance(static_cast<std::uint32_t>(n))[0];
           const auto text = [&] {
             return fmt::format("{} samples: mean {:.17g}, variance {:.9g}, not {:.17g} and {:.9g}",
                                n, static_cast<double>(got), found, static_cast<double>(mean),
                                static_cast<double>(variance));
           };
           for (Tally& tally : tallies) tally.trial(n);
           tallies[0].measure(static_cast<double>(std::abs(got / mean - 1)), text);
           tallies[1].measure(static_cast<double>(std::abs(found / variance - 1)), text);
           Film equal(1, 1, whole.unit());
           render_mixed({&scenes[kMagnitudes - 1], 1}, 0, each, equal);
           const double spread = equal.variance(static_cast<std::uint32_t>(each))[0];
           tallies[2].measure(spread / std::pow(magnitude(kMagnitudes - 1), 2), text);
           if (a.r + b.r != sum.r || a.g + b.g != sum.g || a.b + b.b != sum.b ||
               a.luminance_squared + b.luminance_squared != sum.luminance_squared) {
             tallies[3].fail([&] { return fmt::format("cut after {} of {}", cut, each); });
           }
         };
       }});
}

}  // namespace

void add_film_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"film",
       "one pixel of a constant environment with red, green and blue of .7, .7e-3 and .7e-6",
       {{"film, drift of the mean", "largest error of a channel / brightest channel", 1e-9, 1e-9}},
       2'000'000,
       1'000'000'000,
       1'000'000'000,
       [](KernelKind kernel) -> Chunk {
         Scene scene = empty_scene();
         scene.environment.kind = EnvironmentKind::Constant;
         scene.environment.color = kColor;
         const auto compiled = compile(scene, kernel);
         return [compiled](Random&, std::uint64_t trials, std::span<Tally> tallies) {
           Film film(1, 1, compiled->film_unit);
           Counters counters;
           Work work{0, 0, 1, 1, 0, static_cast<std::uint32_t>(trials), 1};
           render(*compiled, work, film.view(), counters);
           const FilmPixel& sum = film.pixels()[0];
           const double step = std::ldexp(film.unit(), -kFilmBits) / static_cast<double>(trials);
           const glm::dvec3 mean = step * glm::dvec3(sum.r, sum.g, sum.b);
           double error = 0;
           for (int k = 0; k < 3; ++k) error = std::max(error, std::abs(mean[k] - kColor[k]));
           tallies[0].trial(trials);
           tallies[0].measure(error / kColor.x, [&] {
             return fmt::format("mean {:.17g} {:.17g} {:.17g}", mean.x, mean.y, mean.z);
           });
         };
       }});
  add_mixed(tests);
}

}  // namespace lightbench::stress
