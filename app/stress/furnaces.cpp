// What rough materials return of uniform light, against quadrature and closed form.

#include <fmt/format.h>

#include <cmath>

#include "app/proof/closed_forms.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/materials.h"

namespace lightbench::stress {
using namespace proof;
namespace {

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
    q.w = number(2);
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
       "white GGX alpha U(.001,1) and fuzz U(.01,1) in turn, cos U(.05,1); 2^18 samples each",
       {{"GGX, reflected share", "against quadrature", 1e-3, 1e-3},
        {"fuzz, reflected share", "against the ball less its cap below", 1e-3, 1e-3}},
       16,
       600,
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
             const double share = reflected_share(*compile(scene, kernel), cosine, 1 << 18);
             const double exact = ggx ? ggx_albedo(cosine, alpha) : fuzz_share_above(cosine, fuzz);
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
