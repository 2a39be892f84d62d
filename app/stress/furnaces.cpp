// What rough materials return of uniform light, against quadrature and closed form.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/materials.h"

namespace lightbench::stress {
namespace {

constexpr double kPi = std::numbers::pi;

double lambda(double alpha, double cosine) {
  const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
  return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

/// Reflected share of a perfectly reflecting GGX surface with height-correlated masking and single
/// scattering: the integral of G2 (o.h) / (o.n h.n) over the microfacet normals, which D cos makes
/// uniform in t and phi where tan^2 = alpha^2 t / (1 - t).
double ggx_share(double alpha, double cosine) {
  constexpr int kGrid = 512;
  const double sine = std::sqrt(1 - cosine * cosine), lambda_o = lambda(alpha, cosine);
  double sum = 0;
  for (int i = 0; i < kGrid; ++i) {
    const double t = (i + 0.5) / kGrid, tangent2 = alpha * alpha * t / (1 - t);
    const double hz = 1 / std::sqrt(1 + tangent2), radius = std::sqrt(tangent2) * hz;
    for (int k = 0; k < kGrid; ++k) {
      const double hx = radius * std::cos(kPi * (k + 0.5) / kGrid);  // half a turn, by symmetry
      const double oh = sine * hx + cosine * hz, iz = 2 * oh * hz - cosine;
      if (oh > 0 && iz > 0) sum += oh / (cosine * hz * (1 + lambda_o + lambda(alpha, iz)));
    }
  }
  return sum / (kGrid * kGrid);
}

/// Share of the ball of the books' fuzz above the surface.
double fuzz_share(double fuzz, double cosine) {
  const double h = fuzz - cosine;  // height of the cap below
  return h > 0 ? 1 - h * h * (3 * fuzz - h) / (4 * fuzz * fuzz * fuzz) : 1;
}

/// Mean weight of so many samples, spread evenly (Kronecker sequence of the plastic constant).
double reflected_share(const RenderScene& scene, double cosine, int count) {
  constexpr double kStep[] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  std::vector<BsdfQuery> queries(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < queries.size(); ++i) {
    BsdfQuery& q = queries[i];
    q.material = 0;
    q.wo = {std::sqrt(1 - cosine * cosine), 0, cosine};
    const auto number = [&](int k) {
      const double x = 0.5 + kStep[k] * static_cast<double>(i);
      return x - std::floor(x);
    };
    q.u = number(0);
    q.v = number(1);
    q.lobe = number(2);
  }
  std::vector<BsdfSample> samples(queries.size());
  sample_bsdf(scene, queries, samples);
  double sum = 0;
  for (const BsdfSample& s : samples) sum += s.valid ? s.weight.x : 0;
  return sum / count;
}

}  // namespace

void add_furnace_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"rough materials in uniform light",
       "white GGX alpha U(.001,1) and fuzz U(.01,1) in turn, cos U(.05,1); 2^17 samples each",
       {{"GGX, reflected share", "against quadrature", 1e-3, 1e-3},
        {"fuzz, reflected share", "against the ball less its cap below", 1e-3, 1e-3}},
       16,
       2'000,
       4,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const bool ggx = i % 2 == 0;
             const double cosine = random.between(0.05, 1);
             const double alpha = random.between(1e-3, 1), fuzz = random.between(0.01, 1);
             Scene scene = empty_scene();
             Material& m = scene.materials[0];
             m.kind = MaterialKind::Metal;
             m.base_color = glm::dvec3(1);
             (ggx ? m.roughness : m.fuzz) = ggx ? std::sqrt(alpha) : fuzz;
             add_object(scene, SphereShape{});
             const double share = reflected_share(*compile(scene, kernel), cosine, 1 << 17);
             const double exact = ggx ? ggx_share(alpha, cosine) : fuzz_share(fuzz, cosine);
             Tally& tally = tallies[ggx ? 0 : 1];
             tally.trial();
             tally.measure(std::abs(share - exact), [&] {
               return fmt::format("{} {:.17g} at cos {:.17g}: {:.9g}, not {:.9g}",
                                  ggx ? "alpha" : "fuzz", ggx ? alpha : fuzz, cosine, share, exact);
             });
           }
         };
       }});
}

}  // namespace lightbench::stress
