#include "app/proof/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/on_threads.h"
#include "core/error.h"

namespace lightbench::proof {

namespace {

/// A dropped sample would bias the mean, of both sides of a comparison perhaps.
void expect_complete(const Counters& counters) {
  if (counters.non_finite == 0) return;
  throw Error(ErrorKind::Internal,
              fmt::format("{} samples were not finite, expected none", counters.non_finite));
}

}  // namespace

Film render_film(const RenderScene& scene, int spp, int first) {
  Film film(scene.crop.width, scene.crop.height, scene.film_unit);
  Work work;
  work.x1 = film.width();
  work.y1 = film.height();
  work.first_sample = static_cast<std::uint32_t>(first);
  work.sample_count = static_cast<std::uint32_t>(spp);
  Counters counters;
  render(scene, work, film.view(), counters);
  expect_complete(counters);
  return film;
}

Film render_film(const Scene& scene, KernelKind kernel, int spp) {
  return render_film(*compile(scene, kernel), spp);
}

Film render_on_threads(const RenderScene& scene, int spp, int threads) {
  Film film(scene.crop.width, scene.crop.height, scene.film_unit);
  constexpr int kEdge = 8;
  const int columns = (film.width() + kEdge - 1) / kEdge,
            rows = (film.height() + kEdge - 1) / kEdge;
  std::vector<Counters> counters(static_cast<std::size_t>(columns * rows));
  for_each_on_threads(0, counters.size(), threads, [&](std::uint64_t tile) {
    const int x = static_cast<int>(tile) % columns * kEdge,
              y = static_cast<int>(tile) / columns * kEdge;
    render(scene,
           {x, y, std::min(x + kEdge, film.width()), std::min(y + kEdge, film.height()), 0,
            static_cast<std::uint32_t>(spp), 1},
           film.view(), counters[tile]);
  });
  for (const Counters& c : counters) expect_complete(c);
  return film;
}

glm::dvec3 pixel_mean(const Film& film, std::size_t i, int spp) {
  const FilmPixel& p = film.pixels()[i];
  const double scale = film.unit() / std::ldexp(1.0, kFilmBits) / spp;
  return scale * glm::dvec3(p.r, p.g, p.b);
}

namespace {

/// Pixels as replicates.
Estimate over_pixels(const Film& film, int spp) {
  std::vector<glm::dvec3> means;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) means.push_back(pixel_mean(film, i, spp));
  return summarize(means);
}

}  // namespace

Estimate measure_uniform(const Scene& scene, KernelKind kernel, int spp) {
  return over_pixels(render_film(scene, kernel, spp), spp);
}

SizedEstimate measure_uniform_to(const Scene& scene, KernelKind kernel, double error, int least_spp,
                                 int most_spp) {
  const auto compiled = compile(scene, kernel);
  Film film(compiled->crop.width, compiled->crop.height, compiled->film_unit);
  Counters counters;
  for (int done = 0, spp = least_spp;; spp = std::min(2 * spp, most_spp)) {
    render(*compiled,
           {0, 0, film.width(), film.height(), static_cast<std::uint32_t>(done),
            static_cast<std::uint32_t>(spp - done), 1},
           film.view(), counters);
    expect_complete(counters);
    done = spp;
    const SizedEstimate e{over_pixels(film, spp), spp};
    if (e.error.y <= error || spp == most_spp) return e;
  }
}

Estimate measure_by_seeds(Scene scene, KernelKind kernel, int spp, int seeds) {
  std::vector<glm::dvec3> means;
  for (int seed = 0; seed < seeds; ++seed) {
    scene.render.seed = static_cast<std::uint32_t>(1000 + seed);
    const Film film = render_film(scene, kernel, spp);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < film.pixels().size(); ++i) sum += pixel_mean(film, i, spp);
    means.push_back(sum / static_cast<double>(film.pixels().size()));
  }
  return summarize(means);
}

}  // namespace lightbench::proof
