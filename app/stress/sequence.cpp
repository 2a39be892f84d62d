// The sample sequence: stratified by pairs of dimensions and by sets of four, evenly distributed,
// independent from pixel to pixel, and as quick to converge as a (0,2)-sequence should be.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/proof/chi_square.h"
#include "app/stress/kernel_functions.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using Points = std::vector<std::array<double, 2>>;

/// Sets of dimensions that paths use: filter and time, three for each of 50 vertices, and the free
/// flights of up to 8 media.
std::uint32_t random_set(Random& random) {
  const auto set = static_cast<std::uint32_t>(random.below(3 + 3 * 50));
  if (random.chance(0.9)) return set;
  return 5U + 3U * static_cast<std::uint32_t>(random.below(50)) +
         (static_cast<std::uint32_t>(random.below(8)) << 16U);
}
/// Half of one of them.
std::uint32_t random_pair(Random& random) {
  return 2 * random_set(random) + static_cast<std::uint32_t>(random.below(2));
}

struct Pixel {
  std::uint32_t x, y, seed;
};
Pixel random_pixel(Random& random) {
  return {static_cast<std::uint32_t>(random.below(4096)),
          static_cast<std::uint32_t>(random.below(4096)),
          static_cast<std::uint32_t>(random.below(1 << 30))};
}

/// The first sample of an aligned block of so many.
std::uint32_t random_block(Random& random, std::size_t size) {
  return static_cast<std::uint32_t>(random.below(64)) * static_cast<std::uint32_t>(size);
}

std::string describe(const Pixel& p, std::uint32_t pair) {
  return fmt::format("pixel {},{} seed {} pair {}", p.x, p.y, p.seed, pair);
}

void add_intervals(std::vector<Test>& tests) {
  tests.push_back(
      {"sequence, elementary intervals",
       "any pixel, seed and dimension pair in use; an aligned block of 2^k samples, k to 12, and "
       "all its 2^k intervals of each of the k + 1 forms",
       {{"sequence, intervals without one point each", "", kNoLimit, kNoLimit, 0}},
       1'000,
       1'000'000,
       64,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const Pixel p = random_pixel(random);
             const std::uint32_t pair = random_pair(random);
             const int k = random.below(13);
             Points points(std::size_t{1} << k);
             const std::uint32_t first = random_block(random, points.size());
             functions_of(kernel).sequence(p.x, p.y, p.seed, pair, first, points);
             bool even = true;
             for (int columns = 0; columns <= k; ++columns) {
               std::vector<bool> taken(points.size());
               for (const auto& u : points) {
                 const auto x = static_cast<std::size_t>(std::ldexp(u[0], columns));
                 const auto y = static_cast<std::size_t>(std::ldexp(u[1], k - columns));
                 const std::size_t cell = (x << (k - columns)) + y;
                 even = even && !taken[cell];
                 taken[cell] = true;
               }
             }
             tallies[0].trial();
             if (!even) {
               tallies[0].fail([&] {
                 return describe(p, pair) + fmt::format(", samples from {}, k = {}", first, k);
               });
             }
           }
         };
       }});
}

/// Whether each box with sides of 4^-digits holds one of the points (a, b); their number is 4 to
/// the sum of the digits.
bool fill_boxes(const Points& a, const Points& b, const std::array<int, 4>& digits) {
  std::vector<bool> taken(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::array<double, 4> u{a[i][0], a[i][1], b[i][0], b[i][1]};
    std::size_t box = 0;
    for (std::size_t d = 0; d < 4; ++d) {
      box = (box << (2 * digits[d])) + static_cast<std::size_t>(std::ldexp(u[d], 2 * digits[d]));
    }
    if (taken[box]) return false;
    taken[box] = true;
  }
  return true;
}

void add_boxes(std::vector<Test>& tests) {
  tests.push_back(
      {"sequence, boxes of four dimensions",
       "any pixel, seed and set in use; an aligned block of 4^k samples, k to 5, and all its 4^k "
       "boxes of each form with sides of powers of 1/4",
       {{"sequence, boxes without one point each", "", kNoLimit, kNoLimit, 0}},
       500,
       200'000,
       64,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; ++i) {
             const Pixel p = random_pixel(random);
             const std::uint32_t set = random_set(random);
             const int k = random.below(6);
             Points a(std::size_t{1} << (2 * k)), b(a.size());
             const std::uint32_t first = random_block(random, a.size());
             functions_of(kernel).sequence(p.x, p.y, p.seed, 2 * set, first, a);
             functions_of(kernel).sequence(p.x, p.y, p.seed, 2 * set + 1, first, b);
             bool even = true;
             for (int x = 0; x <= k; ++x) {
               for (int y = 0; x + y <= k; ++y) {
                 for (int z = 0; x + y + z <= k; ++z) {
                   even = even && fill_boxes(a, b, {x, y, z, k - x - y - z});
                 }
               }
             }
             tallies[0].trial();
             if (!even) {
               tallies[0].fail([&] {
                 return describe(p, 2 * set) + fmt::format(", samples from {}, k = {}", first, k);
               });
             }
           }
         };
       }});
}

/// Coordinate `axis` of one sample of `count` pixels in a square, row by row.
std::vector<double> across_pixels(const KernelFunctions& functions, const Pixel& corner, int side,
                                  std::uint32_t pair, std::size_t axis, std::uint32_t sample) {
  std::vector<double> values;
  for (int k = 0; k < side * side; ++k) {
    std::array<double, 2> u{};
    functions.sequence(corner.x + static_cast<std::uint32_t>(k % side),
                       corner.y + static_cast<std::uint32_t>(k / side), corner.seed, pair, sample,
                       {&u, 1});
    values.push_back(u[axis]);
  }
  return values;
}

void add_dimensions(std::vector<Test>& tests) {
  tests.push_back(
      {"sequence, across pixels",
       "any seed and sample index, 128 x 128 pixels; dimensions 0 to 63 in turn",
       {{"sequence, chi-square of a dimension", "-log10 p", 0, 0, 0, 0.01},
        {"sequence, correlation of pixels or dimensions", "-log10 p", 0, 0, 0, 0.01}},
       64,
       20'000,
       64,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           constexpr int kSide = 128;
           constexpr std::size_t kCount = kSide * kSide, kCells = 64;
           const KernelFunctions& functions = functions_of(kernel);
           for (std::uint64_t i = 0; i < trials; ++i) {
             const Pixel p = random_pixel(random);
             const auto sample = static_cast<std::uint32_t>(random.below(1 << 20));
             const auto pair = static_cast<std::uint32_t>(i / 2 % 32);
             const std::vector<double> a = across_pixels(functions, p, kSide, pair, i % 2, sample);
             std::vector<double> observed(kCells);
             for (const double x : a) observed[static_cast<std::size_t>(x * kCells)] += 1;
             const std::vector<double> expected(kCells, double{kCount} / kCells);
             const proof::ChiSquare r = proof::chi_square(observed, expected);
             const auto text = [&] {
               return describe(p, pair) + fmt::format(" sample {}", sample);
             };
             tallies[0].trial();
             tallies[0].measure(-std::log10(r.p_value), text);
             // Against the pixels next to them, another pair, or the other axis.
             Pixel q = p;
             std::uint32_t other = pair;
             const int kind = random.below(3);
             if (kind == 0) ++(random.chance(0.5) ? q.x : q.y);
             if (kind == 1) other += 1U + static_cast<std::uint32_t>(random.below(8));
             const std::vector<double> b =
                 across_pixels(functions, q, kSide, other, kind == 2 ? 1 - i % 2 : i % 2, sample);
             double sum = 0;
             for (std::size_t n = 0; n < kCount; ++n) sum += (a[n] - 0.5) * (b[n] - 0.5);
             const double z = std::abs(sum) * 12 / std::sqrt(double{kCount});
             tallies[1].trial();
             tallies[1].measure(-std::log10(std::erfc(z / std::numbers::sqrt2)), text);
           }
         };
       }});
}

/// Integrands over the square with mean and standard deviation.
struct Integrand {
  double (*f)(double x, double y);
  double mean, deviation;
};
constexpr double kE = std::numbers::e;
const Integrand kSmooth{[](double x, double y) { return std::exp(x + y); }, (kE - 1) * (kE - 1),
                        std::sqrt(std::pow(0.5 * (kE * kE - 1), 2) - std::pow(kE - 1, 4))};
constexpr double kDisk = std::numbers::pi * 0.4 * 0.4;
const Integrand kDiskEdge{[](double x, double y) {
                            return (x - 0.47) * (x - 0.47) + (y - 0.53) * (y - 0.53) < 0.16 ? 1.0
                                                                                            : 0.0;
                          },
                          kDisk, std::sqrt(kDisk*(1 - kDisk))};

/// Root mean square error of the means of the first n samples, over many pixels.
std::vector<double> errors(Random& random, const KernelFunctions& functions, const Integrand& f,
                           std::span<const std::size_t> counts) {
  constexpr int kPixels = 1024;
  std::vector<double> squares(counts.size());
  Points points(counts.back());
  for (int k = 0; k < kPixels; ++k) {
    const Pixel p = random_pixel(random);
    functions.sequence(p.x, p.y, p.seed, random_pair(random), 0, points);
    double sum = 0;
    std::size_t n = 0;
    for (std::size_t c = 0; c < counts.size(); ++c) {
      for (; n < counts[c]; ++n) sum += f.f(points[n][0], points[n][1]);
      const double error = sum / static_cast<double>(n) - f.mean;
      squares[c] += error * error / kPixels;
    }
  }
  for (double& s : squares) s = std::sqrt(s);
  return squares;
}

/// Of log error over log count at powers of two from 32 up.
double slope(std::span<const std::size_t> counts, std::span<const double> errors) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (counts[c] < 32 || (counts[c] & (counts[c] - 1)) != 0) continue;
    const double x = std::log(static_cast<double>(counts[c])), y = std::log(errors[c]);
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void add_convergence(std::vector<Test>& tests) {
  tests.push_back(
      {"sequence, convergence",
       "exp(x + y) and a disk over the square; the error over 1024 pixels of the first 1 to 4096 "
       "samples, powers of two and numbers between them",
       {{"sequence, slope of a smooth integrand's error", "2 + slope", 0.6, 0.6},
        {"sequence, slope of a disk's error", "2 + slope", 1.3, 1.3},
        // 1024 pixels tell a standard deviation to 2 %.
        {"sequence, error over that of independent samples", "ratio", 1.1, 1.1}},
       2,
       200,
       1,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           constexpr std::size_t kCounts[] = {1,   2,   3,   4,   5,    7,    8,    11,
                                              16,  23,  32,  48,  64,   100,  128,  200,
                                              256, 400, 512, 777, 1024, 2048, 3000, 4096};
           for (std::uint64_t i = 0; i < trials; ++i) {
             for (std::size_t which = 0; which < 2; ++which) {
               const Integrand& f = which == 0 ? kSmooth : kDiskEdge;
               const std::vector<double> e = errors(random, functions_of(kernel), f, kCounts);
               const double found = slope(kCounts, e);
               tallies[which].trial();
               tallies[which].measure(2 + found,
                                      [&] { return fmt::format("slope {:.3g}", found); });
               for (std::size_t c = 0; c < std::size(kCounts); ++c) {
                 const double ratio =
                     e[c] * std::sqrt(static_cast<double>(kCounts[c])) / f.deviation;
                 tallies[2].trial();
                 tallies[2].measure(ratio, [&] {
                   return fmt::format("integrand {}, {} samples: ratio {:.3g}", which, kCounts[c],
                                      ratio);
                 });
               }
             }
           }
         };
       }});
}

}  // namespace

void add_sequence_tests(std::vector<Test>& tests) {
  add_intervals(tests);
  add_boxes(tests);
  add_dimensions(tests);
  add_convergence(tests);
}

}  // namespace lightbench::stress
