#pragma once
// The random numbers of one chunk of trials: the same on every machine and for any number of
// threads.

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>
#include <string_view>

namespace lightbench::stress {

class Random {
 public:
  /// Chunk `chunk` of the test of this name, in the run of this seed.
  Random(std::uint64_t seed, std::string_view test, std::uint64_t chunk) {
    std::uint64_t name = 0xcbf29ce484222325U;
    for (const char c : test) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    std::seed_seq seeds{seed, seed >> 32U, name, name >> 32U, chunk, chunk >> 32U};
    engine_.seed(seeds);
  }

  /// [0,1), 53 bits.
  double unit() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// 10^x with x uniform between the two logarithms.
  double decade(double low, double high) { return std::pow(10.0, between(low, high)); }
  int below(int count) { return static_cast<int>(unit() * count); }
  bool chance(double share) { return unit() < share; }
  /// Unit, uniform over the sphere.
  glm::dvec3 direction() {
    const double z = between(-1, 1), a = between(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(a), r * std::sin(a), z};
  }
  /// Unit, uniform over the circle around unit n.
  glm::dvec3 across(const glm::dvec3& n) {
    for (;;) {
      const glm::dvec3 v = glm::cross(n, direction());
      if (glm::length(v) > 0.01) return glm::normalize(v);
    }
  }
  glm::dvec3 in_cube(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lightbench::stress
