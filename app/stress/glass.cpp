// Smooth glass: Snell's law, the critical angle and Fresnel's reflectance, from grazing to normal
// incidence, against long double.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/materials.h"

namespace lightbench::stress {
namespace {

constexpr int kMaterials = 64;
constexpr double kLast = 1 - 0x1p-53;  ///< refracts whenever refraction is possible at all

enum GlassLine { kSnell, kCritical, kReflectance, kTotal };

/// What the textbook says of one query.
struct Exact {
  Number ratio;         ///< index here over index beyond
  Number sine, cosine;  ///< of wo
  Number cosine2;       ///< squared cosine beyond, negative in total reflection
  Number reflectance;
};

Exact exact_of(const BsdfQuery& q, double ior) {
  const V n = glm::normalize(V(q.normal)), w = glm::normalize(V(q.wo));
  Exact e{};
  e.sine = glm::length(glm::cross(n, w));
  e.cosine = std::abs(glm::dot(n, w));
  e.ratio = glm::dot(n, w) > 0 ? 1 / Number(ior) : Number(ior);
  e.cosine2 = 1 - e.ratio * e.ratio * e.sine * e.sine;
  e.reflectance = 1;
  if (e.cosine2 > 0) {
    const Number beyond = std::sqrt(e.cosine2);
    const Number s =
        (e.ratio * e.cosine - beyond) / (e.ratio * e.cosine + beyond);  // perpendicular
    const Number p = (e.cosine - e.ratio * beyond) / (e.cosine + e.ratio * beyond);
    e.reflectance = (s * s + p * p) / 2;
  }
  return e;
}

/// Grazing 10^U(-5,0), or within 10^U(-16,-1) of the critical angle on either side.
BsdfQuery random_query(Random& random, const std::vector<double>& iors) {
  BsdfQuery q;
  q.material = random.below(kMaterials);
  const double ior = iors[static_cast<std::size_t>(q.material)];
  q.normal = random.direction();
  double cosine = random.decade(-5, 0);
  bool outside = random.chance(0.5);
  if (ior != 1 && random.chance(0.5)) {
    outside = ior < 1;
    const double least = outside ? ior : 1 / ior;  // sine of the critical angle
    const double sine = std::clamp(least + random.decade(-16, -1) * (random.chance(0.5) ? 1 : -1),
                                   0.0, 1 - 0.5e-10);
    cosine = std::sqrt(1 - sine * sine);
  }
  q.wo = (outside ? cosine : -cosine) * q.normal +
         std::sqrt(1 - cosine * cosine) * random.across(q.normal);
  return q;
}

bool reflected(const BsdfQuery& q, const BsdfSample& s) {
  return glm::dot(s.wi, q.normal) * glm::dot(q.wo, q.normal) > 0;
}

/// Share of the numbers `u` that reflect, by bisection.
std::vector<double> reflectances(const RenderScene& scene, std::vector<BsdfQuery> queries) {
  std::vector<double> low(queries.size(), 0), high(queries.size(), 1);
  std::vector<BsdfSample> samples(queries.size());
  for (int step = 0; step < 53; ++step) {
    for (std::size_t i = 0; i < queries.size(); ++i) queries[i].u = 0.5 * (low[i] + high[i]);
    sample_bsdf(scene, queries, samples);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      (reflected(queries[i], samples[i]) ? low : high)[i] = queries[i].u;
    }
  }
  return low;
}

void judge(const BsdfQuery& q, double ior, const BsdfSample& refracted, double reflectance,
           double rounding, std::span<Tally> tallies) {
  const Exact e = exact_of(q, ior);
  const bool total = reflected(q, refracted);
  const V n = glm::normalize(V(q.normal)), wi(refracted.wi);
  const Number beyond = total ? 0 : std::abs(glm::dot(n, wi));
  const auto text = [&] {
    return fmt::format(
        "ior {:.17g}, n {} wo {}: wi {}, reflectance {:.17g} not {:.17g}, cos^2 "
        "beyond {:.17g}",
        ior, to_text(q.normal), to_text(q.wo), to_text(refracted.wi), reflectance,
        static_cast<double>(e.reflectance), static_cast<double>(e.cosine2));
  };
  const auto measure = [&](GlassLine line, Number value) {
    tallies[line].trial();
    tallies[line].measure(static_cast<double>(value), text);
  };
  const Number scale = std::max(Number(1), e.ratio * e.ratio);
  if (!total && e.cosine2 > 0) {
    // Plane and angle at once: the tangential parts are opposite and in the ratio of the indices.
    const V tangential = wi - glm::dot(wi, n) * n + e.ratio * (V(q.wo) - glm::dot(V(q.wo), n) * n);
    measure(kSnell, glm::length(tangential) / std::max(Number(1), e.ratio));
  }
  measure(kCritical, std::abs(beyond * beyond - std::max(e.cosine2, Number(0))) / scale);
  const Number steep = std::max({std::sqrt(std::max(e.cosine2, Number(0))), beyond});
  measure(kReflectance, std::abs(reflectance - e.reflectance) * steep * e.cosine / scale);
  if (std::abs(e.cosine2) > 64 * scale * Number(rounding)) {
    tallies[kTotal].trial();
    if (total != (e.cosine2 < 0)) tallies[kTotal].fail(text);
  }
}

}  // namespace

void add_glass_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"glass",
       "ior 10^U(-.4,.4), from either side; cos 10^U(-5,0), half of them within 10^U(-16,-1) of "
       "the critical angle",
       {{"glass, Snell's law", "length of n wo + n' wi along the surface / larger index", 1e-12,
         1e-6},
        {"glass, squared cosine beyond", "error / max(1, squared index)", 1e-12, 1e-6},
        {"glass, Fresnel's reflectance", "error * cosines here and beyond / max(1, squared index)",
         1e-12, 4e-6},
        {"glass, total reflection", "", kNoLimit, kNoLimit, 0}},
       20'000,
       10'000'000,
       4096,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           Scene scene = empty_scene();
           std::vector<double> iors;
           for (int k = 0; k < kMaterials; ++k) {
             // What float holds exactly: the index is the same in every kernel.
             iors.push_back(static_cast<double>(static_cast<float>(random.decade(-0.4, 0.4))));
             Material glass;
             glass.name = fmt::format("glass {}", k);
             glass.kind = MaterialKind::Dielectric;
             glass.base_color = glm::dvec3(1);
             glass.ior = iors.back();
             scene.materials.push_back(glass);
           }
           scene.materials.erase(scene.materials.begin());
           add_object(scene, SphereShape{});
           const auto compiled = compile(scene, kernel);
           std::vector<BsdfQuery> queries(trials);
           for (BsdfQuery& q : queries) q = random_query(random, iors);
           const std::vector<double> reflectance = reflectances(*compiled, queries);
           for (BsdfQuery& q : queries) q.u = kLast;
           std::vector<BsdfSample> samples(trials);
           sample_bsdf(*compiled, queries, samples);
           for (std::size_t i = 0; i < trials; ++i) {
             judge(queries[i], iors[static_cast<std::size_t>(queries[i].material)], samples[i],
                   reflectance[i], rounding_of(*compiled), tallies);
           }
         };
       }});
}

}  // namespace lightbench::stress
