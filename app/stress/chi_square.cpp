// Samples of every BSDF against the densities that it states: chi-square in coordinates that fit
// the lobe, so that one a thousandth of a radian wide is resolved like a wide one.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/proof/chi_square.h"
#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"
#include "core/query/materials.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;
constexpr int kCells = 16, kFine = 10;  ///< cells per axis, points of quadrature per cell and axis
constexpr std::size_t kSamples = 1 << 15;
constexpr double kCosines[] = {1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.15, 0.2,  0.25,
                               0.3,  0.4,  0.5,  0.6,  0.7,  0.8,  0.9, 0.95, 0.99, 1};
constexpr double kAlphas[] = {1e-3, 1e-2, 0.1, 0.3, 0.6, 1};
constexpr double kFuzz[] = {0.01, 0.1, 0.5, 1};

enum class Lobe { Lambertian, Ggx, Fuzz };
enum ChiSquareLine { kChiSquare, kIntegral, kStray };

struct Case {
  Lobe lobe = Lobe::Lambertian;
  double width = 1;  ///< alpha or fuzz
  double cosine = 1;
  dvec3 x{1, 0, 0}, y{0, 1, 0}, n{0, 0, 1}, wo{0, 0, 1};
};

Case random_case(Random& random) {
  Case c;
  c.lobe = random.chance(0.1) ? Lobe::Lambertian : random.chance(0.6) ? Lobe::Ggx : Lobe::Fuzz;
  if (c.lobe == Lobe::Ggx) c.width = kAlphas[random.below(std::size(kAlphas))];
  if (c.lobe == Lobe::Fuzz) c.width = kFuzz[random.below(std::size(kFuzz))];
  c.cosine = kCosines[random.below(std::size(kCosines))];
  c.n = random.direction();
  c.x = random.across(c.n);
  c.y = glm::cross(c.n, c.x);
  c.wo = c.cosine * c.n + std::sqrt(1 - c.cosine * c.cosine) * c.x;
  return c;
}

std::shared_ptr<const RenderScene> compile_case(const Case& c, KernelKind kernel) {
  Scene scene = empty_scene();
  Material& m = scene.materials[0];
  m.base_color = dvec3(1);
  if (c.lobe != Lobe::Lambertian) m.kind = MaterialKind::Metal;
  if (c.lobe == Lobe::Ggx) m.roughness = std::sqrt(c.width);
  if (c.lobe == Lobe::Fuzz) m.fuzz = c.width;
  add_object(scene, SphereShape{});
  return compile(scene, kernel);
}

/// Coordinates (a, b) in [0,1)^2 of directions, and back with solid angle per unit of (a, b).
struct Chart {
  dvec3 x, y, z;     ///< around z; z is the normal, or the mirror direction
  double cone = 0;   ///< 1 - cos at a = 1; 0: by the half vector instead
  double alpha = 1;  ///< (1 - a)^2 is then the share of GGX normals that are steeper
  dvec3 wo;

  void coordinates(const dvec3& wi, double& a, double& b) const {
    const dvec3 w = cone > 0 ? wi : wo + wi;
    const double px = glm::dot(w, x), py = glm::dot(w, y), pz = glm::dot(w, z);
    if (cone > 0) {
      a = (pz > 0 ? (px * px + py * py) / (1 + pz) : 1 - pz) / cone;
    } else {
      const double s2 = (px * px + py * py) / (pz * pz) / (alpha * alpha);
      a = s2 / (1 + s2) / (1 + 1 / std::sqrt(1 + s2));
    }
    b = turn(py, px);
  }
  dvec3 direction(double a, double b, double& stretch) const {
    const double phi = 2 * kPi * b;
    if (cone > 0) {
      const double rest = a * cone, sine = std::sqrt(rest * (2 - rest));
      stretch = 2 * kPi * cone;
      return sine * std::cos(phi) * x + sine * std::sin(phi) * y + (1 - rest) * z;
    }
    const double rest = (1 - a) * (1 - a), tangent2 = alpha * alpha * (1 - rest) / rest;
    const double cosine = 1 / std::sqrt(1 + tangent2), sine = std::sqrt(tangent2) * cosine;
    const dvec3 h = sine * std::cos(phi) * x + sine * std::sin(phi) * y + cosine * z;
    const double oh = glm::dot(wo, h);
    // dwi = 4 (wo . h) dh
    const double dh = kPi * std::pow(cosine, 3) * alpha * alpha / (rest * rest) * 2 * (1 - a);
    stretch = oh > 0 ? 4 * oh * dh : 0;
    return 2 * oh * h - wo;
  }
};

Chart chart_of(const Case& c) {
  if (c.lobe == Lobe::Ggx) return {c.x, c.y, c.n, 0, c.width, c.wo};
  if (c.lobe == Lobe::Lambertian) return {c.x, c.y, c.n, 1, 1, c.wo};
  const double f = c.width;
  // A little wider than the ball, for rounding.
  const double cone = f < 1 ? 1.00001 * f * f / (1 + std::sqrt(1 - f * f)) : 1;
  const dvec3 mirror = 2 * c.cosine * c.n - c.wo;
  const dvec3 side = glm::normalize(glm::cross(mirror, c.y));
  return {side, glm::cross(mirror, side), mirror, cone, 1, c.wo};
}

std::size_t cell_of(double a, double b) {
  const auto at = [](double c) {
    return static_cast<std::size_t>(std::clamp(c * kCells, 0.0, kCells - 1.0));
  };
  return at(a) * kCells + at(b);
}

/// Counts of samples; the last is that of the invalid ones.
std::vector<double> observe(Random& random, const RenderScene& scene, const Case& c,
                            const Chart& chart, std::size_t& stray) {
  std::vector<BsdfQuery> queries(kSamples);
  for (BsdfQuery& q : queries) {
    q = {0, c.n, c.wo, {}, random.unit(), random.unit(), random.unit()};
  }
  std::vector<BsdfSample> samples(kSamples);
  sample_bsdf(scene, queries, samples);
  for (std::size_t i = 0; i < kSamples; ++i) queries[i].wi = samples[i].valid ? samples[i].wi : c.n;
  std::vector<BsdfValue> values(kSamples);
  eval_bsdf(scene, queries, values);
  std::vector<double> observed(kCells * kCells + 1);
  stray = 0;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const BsdfSample& s = samples[i];
    if (s.valid && !(values[i].pdf > 0)) ++stray;
    double a = 0, b = 0;
    // Unit to the kernel's rounding, which another line asks; the chart wants it exactly.
    if (s.valid) chart.coordinates(glm::normalize(s.wi), a, b);
    observed[s.valid ? cell_of(a, b) : kCells * kCells] += 1;
  }
  return observed;
}

/// By halving; f changes its sign.
double zero_between(const auto& f, double begin, double end) {
  const bool positive = f(begin) > 0;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (begin + end);
    ((f(middle) > 0) == positive ? begin : end) = middle;
  }
  return 0.5 * (begin + end);
}

/// Points of quadrature in a cell.
struct Quadrature {
  std::vector<BsdfQuery> queries;
  std::vector<double> weights;  ///< solid angle
  std::vector<std::size_t> cells;
  double least = 1, most = -1;  ///< cosine to the normal

  void add_cell(const Case& c, const Chart& chart, std::size_t cell, int fine) {
    const double step = 1.0 / (kCells * fine);
    const std::size_t row = cell / kCells;
    for (int i = 0; i < fine; ++i) {
      const double a = static_cast<double>(row) / kCells + (i + 0.5) * step;
      const auto height = [&](double b) {
        double stretch = 0;
        return glm::dot(chart.direction(a, b, stretch), c.n);
      };
      double begin = static_cast<double>(cell % kCells) / kCells, below = height(begin);
      for (int k = 0; k < fine; ++k) {
        const double end = begin + step, above = height(end);
        least = std::min({least, below, above});
        most = std::max({most, below, above});
        // Of a piece that the horizon cuts, what is above it: the slice may be thinner than that.
        const double cut = (below > 0) == (above > 0) ? end : zero_between(height, begin, end);
        add_piece(c, chart, cell, a, begin, cut, step);
        if (cut < end) add_piece(c, chart, cell, a, cut, end, step);
        begin = end;
        below = above;
      }
    }
  }
  void add_piece(const Case& c, const Chart& chart, std::size_t cell, double a, double b0,
                 double b1, double height) {
    double stretch = 0;
    const dvec3 wi = chart.direction(a, 0.5 * (b0 + b1), stretch);
    if (!(glm::dot(wi, c.n) > 0) || stretch <= 0) return;
    queries.push_back({0, c.n, c.wo, wi, 0, 0, 0});
    weights.push_back(stretch * height * (b1 - b0));
    cells.push_back(cell);
  }
  void append(const Quadrature& other) {
    queries.insert(queries.end(), other.queries.begin(), other.queries.end());
    weights.insert(weights.end(), other.weights.begin(), other.weights.end());
    cells.insert(cells.end(), other.cells.begin(), other.cells.end());
  }
};

/// Counts that the densities expect above the surface.
std::vector<double> expect(const RenderScene& scene, const Case& c, const Chart& chart) {
  Quadrature all;
  for (std::size_t cell = 0; cell < std::size_t{kCells} * kCells; ++cell) {
    Quadrature one;
    one.add_cell(c, chart, cell, kFine);
    // Cells that the horizon cuts, or may: finer.
    const double margin = 2 * (one.most - one.least) / kFine;
    if (one.least < margin && one.most > -margin) {
      one = {};
      one.add_cell(c, chart, cell, 6 * kFine);
    }
    all.append(one);
  }
  std::vector<BsdfValue> values(all.queries.size());
  eval_bsdf(scene, all.queries, values);
  std::vector<double> expected(kCells * kCells + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    expected[all.cells[i]] += values[i].pdf * all.weights[i] * static_cast<double>(kSamples);
  }
  return expected;
}

void judge(Random& random, const Case& c, KernelKind kernel, std::span<Tally> tallies) {
  const auto scene = compile_case(c, kernel);
  const Chart chart = chart_of(c);
  std::size_t stray = 0;
  const std::vector<double> observed = observe(random, *scene, c, chart, stray);
  std::vector<double> expected = expect(*scene, c, chart);
  constexpr auto kCount = static_cast<double>(kSamples);
  double total = 0;
  for (const double e : expected) total += e / kCount;
  const double invalid = observed.back() / kCount;
  // The invalid samples are known by their number only: it is expected as it is.
  expected.back() = observed.back();
  const double noise = 4.5 * std::sqrt(invalid * (1 - invalid) / kCount);
  const proof::ChiSquare r = proof::chi_square(observed, expected);
  const auto text = [&] {
    return fmt::format(
        "{} {} cos {} n {}: chi-square {:.6g} of {}, integral {:.6g}, invalid "
        "{:.6g}, stray {}",
        c.lobe == Lobe::Lambertian ? "Lambertian"
        : c.lobe == Lobe::Ggx      ? "alpha"
                                   : "fuzz",
        c.width, c.cosine, to_text(c.n), r.statistic, r.freedom, total, invalid, stray);
  };
  for (Tally& tally : tallies) tally.trial();
  tallies[kChiSquare].measure(-std::log10(r.p_value), text);
  tallies[kIntegral].measure(std::max(0.0, std::abs(total + invalid - 1) - noise), text);
  if (stray > 0) tallies[kStray].fail(text);
}

}  // namespace

void add_chi_square_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"material densities",
       "Lambertian, GGX alpha .001 to 1, fuzz .01 to 1, 20 angles of cos .001 to 1, any normal; "
       "32768 samples each in 16 x 16 cells",
       {{"material, chi-square of samples", "-log10 p", 0, 0, 0, 0.01},
        {"material, integral of the density", "|integral + invalid share - 1| beyond noise", 1e-3,
         1e-3},
        {"material, samples where the density is 0", "", kNoLimit, kNoLimit, 0}},
       24,
       10'000,
       4,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             judge(random, random_case(random), kernel, tallies);
           }
         };
       }});
}

}  // namespace lightbench::stress
