// Materials at every angle: energy, reciprocity, weights of samples, random numbers at the ends.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/materials.h"

namespace lightbench::stress {
namespace {

enum class Lobe { Lambertian, Mirror, Fuzz, Ggx, Glass };
constexpr Lobe kLobes[] = {Lobe::Lambertian, Lobe::Mirror, Lobe::Fuzz, Lobe::Ggx, Lobe::Glass};

/// A white material, smooth or rough as drawn.
struct Surface {
  Lobe lobe = Lobe::Lambertian;
  Material material;
  std::shared_ptr<const RenderScene> scene;
};

Surface random_surface(Random& random, Lobe lobe, KernelKind kernel) {
  Surface s;
  s.lobe = lobe;
  Material& m = s.material;
  m.base_color = glm::dvec3(1);
  m.kind = lobe == Lobe::Lambertian
               ? MaterialKind::Lambertian
               : (lobe == Lobe::Glass ? MaterialKind::Dielectric : MaterialKind::Metal);
  if (lobe == Lobe::Fuzz) m.fuzz = random.decade(-3, 0);
  if (lobe == Lobe::Ggx) m.roughness = random.decade(-2, 0);  // alpha from 1e-4
  if (lobe == Lobe::Glass) m.ior = random.decade(-0.4, 0.4);
  Scene scene = empty_scene();
  m.name = "tested";
  scene.materials[0] = m;
  add_object(scene, SphereShape{});
  s.scene = compile(scene, kernel);
  return s;
}

std::string describe(const Surface& s, const BsdfQuery& q) {
  return fmt::format(
      "material {} fuzz {:.17g} roughness {:.17g} ior {:.17g}, n {} wo {} wi {} u "
      "{:.17g} {:.17g} {:.17g}",
      static_cast<int>(s.material.kind), s.material.fuzz, s.material.roughness, s.material.ior,
      to_text(q.normal), to_text(q.wo), to_text(q.wi), q.u, q.v, q.w);
}

/// Unit, at cos 10^U(-4,0) to n, on either side.
glm::dvec3 random_wo(Random& random, const glm::dvec3& n) {
  const double cosine = random.decade(-4, 0) * (random.chance(0.5) ? 1 : -1);
  return cosine * n + std::sqrt(1 - cosine * cosine) * random.across(n);
}

BsdfQuery random_query(Random& random) {
  BsdfQuery q;
  q.material = 0;
  q.normal = random.direction();
  q.wo = random_wo(random, q.normal);
  return q;
}

/// Share of the light from wo that leaves again; radiance's square of the index is taken out.
double reflected_share(const Surface& s, BsdfQuery q) {
  constexpr int kGrid = 32;
  std::vector<BsdfQuery> queries;
  for (int i = 0; i < kGrid; ++i) {
    for (int k = 0; k < kGrid; ++k) {
      q.u = (i + 0.5) / kGrid;
      q.v = (k + 0.5) / kGrid;
      q.w = (static_cast<int>(queries.size()) * 619 % (kGrid * kGrid) + 0.5) / (kGrid * kGrid);
      queries.push_back(q);
    }
  }
  std::vector<BsdfSample> samples(queries.size());
  sample_bsdf(*s.scene, queries, samples);
  double sum = 0;
  for (const BsdfSample& sample : samples) {
    if (!sample.valid) continue;
    double weight = std::max({sample.weight.x, sample.weight.y, sample.weight.z});
    const double out = glm::dot(q.wo, q.normal), in = glm::dot(sample.wi, q.normal);
    if (out * in < 0) {
      const double index = out > 0 ? s.material.ior : 1 / s.material.ior;
      weight *= index * index;
    }
    sum += weight;
  }
  return sum / static_cast<double>(samples.size());
}

void add_energy(std::vector<Test>& tests) {
  tests.push_back(
      {"material energy",
       "white Lambertian, mirror, fuzz 10^U(-3,0), GGX alpha 10^U(-4,0), glass of index "
       "10^U(-.4,.4); cos 10^U(-4,0), both sides; 1024 samples each",
       {{"material, energy gained", "reflected share - 1", 1e-3, 1e-3},
        {"Lambertian, mirror and glass, energy lost", "1 - reflected share", 1e-3, 1e-3}},
       2'000,
       1'000'000,
       100,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const Lobe lobe = kLobes[i % std::size(kLobes)];
             const Surface s = random_surface(random, lobe, kernel);
             const BsdfQuery q = random_query(random);
             const double share = reflected_share(s, q);
             const auto text = [&] { return fmt::format("{:.9g}: {}", share, describe(s, q)); };
             tallies[0].trial();
             tallies[0].measure(share - 1, text);
             if (lobe == Lobe::Fuzz || lobe == Lobe::Ggx) continue;
             tallies[1].trial();
             tallies[1].measure(1 - share, text);
           }
         };
       }});
}

void add_reciprocity(std::vector<Test>& tests) {
  tests.push_back(
      {"material reciprocity",
       "Lambertian and GGX alpha 10^U(-4,0); both directions at cos 10^U(-4,0), or for GGX near "
       "the mirror direction",
       {{"material, reciprocity", "relative error * min(1, alpha * cos)", 1e-12, 2e-5}},
       100'000,
       10'000'000,
       512,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           const Lobe lobe = random.chance(0.2) ? Lobe::Lambertian : Lobe::Ggx;
           const Surface s = random_surface(random, lobe, kernel);
           const double alpha = lobe == Lobe::Ggx ? s.material.roughness * s.material.roughness : 1;
           std::vector<BsdfQuery> there(trials), back;
           for (BsdfQuery& q : there) {
             q = random_query(random);
             if (glm::dot(q.wo, q.normal) < 0) q.wo = -q.wo;
             q.wi = random_wo(random, q.normal);
             if (random.chance(0.7)) {
               q.wi = 2 * glm::dot(q.wo, q.normal) * q.normal - q.wo +
                      alpha * random.unit() * random.direction();
             }
             if (glm::dot(q.wi, q.normal) < 0) q.wi = -q.wi;
             q.wi = glm::normalize(q.wi);
             back.push_back(q);
             std::swap(back.back().wo, back.back().wi);
           }
           std::vector<BsdfValue> a(trials), b(trials);
           eval_bsdf(*s.scene, there, a);
           eval_bsdf(*s.scene, back, b);
           for (std::size_t i = 0; i < trials; ++i) {
             const double out = glm::dot(there[i].wo, there[i].normal);
             const double in = glm::dot(there[i].wi, there[i].normal);
             const double f = a[i].value.x / in, g = b[i].value.x / out;
             if (f + g < 1e-30) continue;
             const double conditioned = std::min(1.0, alpha * std::min(out, in));
             tallies[0].trial();
             tallies[0].measure(2 * std::abs(f - g) / (f + g) * conditioned, [&] {
               return fmt::format("{:.9g} and {:.9g}: {}", f, g, describe(s, there[i]));
             });
           }
         };
       }});
}

enum SampleLine { kWeight, kPdf, kEnds };

void add_samples(std::vector<Test>& tests) {
  tests.push_back(
      {"material samples",
       "all materials, cos 10^U(-4,0), both sides; a third of the random numbers from {0, 2^-53, "
       "2^-32, 2^-24, .5, 1-2^-24, 1-2^-53}",
       {{"material, weight against value / pdf", "relative error * cos", 1e-12, 2e-5},
        {"material, pdf of a sample's direction",
         "relative error * min(1, alpha, fuzz) * cos; of fuzz * (pdf / peak)^2", 1e-12, 2e-5},
        {"material, NaN, infinite, pdf <= 0 or not unit", "", kNoLimit, kNoLimit, 0}},
       150'000,
       10'000'000,
       512,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           constexpr double kEdges[] = {0,   0x1p-53,     0x1p-32,    0x1p-24,
                                        0.5, 1 - 0x1p-24, 1 - 0x1p-53};
           const Lobe lobe = kLobes[random.below(static_cast<int>(std::size(kLobes)))];
           const Surface s = random_surface(random, lobe, kernel);
           std::vector<BsdfQuery> queries(trials);
           const auto number = [&] {
             return random.chance(0.33) ? kEdges[random.below(std::size(kEdges))] : random.unit();
           };
           for (BsdfQuery& q : queries) {
             q = random_query(random);
             q.u = number();
             q.v = number();
             q.w = number();
           }
           std::vector<BsdfSample> samples(trials);
           sample_bsdf(*s.scene, queries, samples);
           for (std::size_t i = 0; i < trials; ++i) {
             queries[i].wi = samples[i].valid ? samples[i].wi : queries[i].normal;
           }
           std::vector<BsdfValue> values(trials);
           eval_bsdf(*s.scene, queries, values);
           double narrow = 1;
           if (lobe == Lobe::Ggx) narrow = s.material.roughness * s.material.roughness;
           if (lobe == Lobe::Fuzz) narrow = s.material.fuzz;
           for (std::size_t i = 0; i < trials; ++i) {
             const BsdfSample& b = samples[i];
             const BsdfValue& v = values[i];
             const auto text = [&] {
               return fmt::format("weight {:.9g}, value {:.9g}, pdf {:.9g} and {:.9g}: {}",
                                  b.weight.x, v.value.x, b.pdf, v.pdf, describe(s, queries[i]));
             };
             tallies[kEnds].trial();
             if (!b.valid) continue;
             const bool sound = (b.delta || (b.pdf > 0 && std::isfinite(b.pdf))) &&
                                b.weight.x >= 0 && std::isfinite(b.weight.x) &&
                                std::abs(glm::length(b.wi) - 1) < 1e-6;
             if (!sound) tallies[kEnds].fail(text);
             if (!sound || b.delta) continue;
             const double cosine = std::min(std::abs(glm::dot(b.wi, queries[i].normal)),
                                            std::abs(glm::dot(queries[i].wo, queries[i].normal)));
             // At the border of the fuzz the chord that the density follows from vanishes.
             const double share = b.pdf * narrow * narrow * (std::numbers::pi / 1.5);
             const double inner = lobe == Lobe::Fuzz ? std::min(1.0, share * share) : 1;
             tallies[kPdf].trial();
             tallies[kPdf].measure(std::abs(v.pdf / b.pdf - 1) * narrow * cosine * inner, text);
             if (!(v.pdf > 0)) continue;
             tallies[kWeight].trial();
             tallies[kWeight].measure(std::abs(v.value.x / v.pdf / b.weight.x - 1) * cosine, text);
           }
         };
       }});
}

}  // namespace

void add_bsdf_tests(std::vector<Test>& tests) {
  add_energy(tests);
  add_reciprocity(tests);
  add_samples(tests);
}

}  // namespace lightbench::stress
