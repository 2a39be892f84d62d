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
}

}  // namespace lightbench::stress
