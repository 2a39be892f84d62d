#include "tests/transport/measure.h"

#include <cmath>

namespace lightbench {

std::ostream& operator<<(std::ostream& out, const KernelUnderTest& kernel) {
  return out << kernel_name(kernel.kind);
}

Film render_film(const RenderScene& scene, int spp, int first) {
  Film film(scene.crop.width, scene.crop.height, scene.film_unit);
  Work work;
  work.x1 = film.width();
  work.y1 = film.height();
  work.first_sample = static_cast<std::uint32_t>(first);
  work.sample_count = static_cast<std::uint32_t>(spp);
  Counters counters;
  render(scene, work, film.view(), counters);
  if (counters.non_finite != 0) {
    // A dropped sample would bias the mean; make the comparison fail.
    for (std::size_t i = 0; i < film.pixels().size(); ++i) film.view().pixels[i] = {-1, -1, -1, 0};
  }
  return film;
}

Film render_film(const Scene& scene, KernelKind kernel, int spp) {
  return render_film(*compile(scene, kernel), spp);
}

glm::dvec3 pixel_mean(const Film& film, std::size_t i, int spp) {
  const FilmPixel& p = film.pixels()[i];
  const double scale = film.unit() / std::ldexp(1.0, kFilmBits) / spp;
  return scale * glm::dvec3(p.r, p.g, p.b);
}

Estimate measure_uniform(const Scene& scene, KernelKind kernel, int spp) {
  const Film film = render_film(scene, kernel, spp);
  std::vector<glm::dvec3> means;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) means.push_back(pixel_mean(film, i, spp));
  return summarize(means);
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

}  // namespace lightbench
