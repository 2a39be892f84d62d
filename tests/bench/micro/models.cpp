#include "tests/bench/micro/models.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lightbench::micro {
namespace {

constexpr double kPi = std::numbers::pi;

/// Adds a grid of rows x columns cells whose corners are point(u, v) for u and v in [0, 1].
template <class Point>
void add_grid(Mesh& mesh, int rows, int columns, Point point) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k <= columns; ++k) {
      mesh.positions.push_back(
          point(static_cast<double>(k) / columns, static_cast<double>(i) / rows));
    }
  }
  const auto width = static_cast<std::uint32_t>(columns + 1);
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const std::uint32_t a =
          first + static_cast<std::uint32_t>(i) * width + static_cast<std::uint32_t>(k);
      mesh.triangles.push_back({a, a + 1, a + width});
      mesh.triangles.push_back({a + 1, a + width + 1, a + width});
    }
  }
}

int side(double cells) { return std::max(2, static_cast<int>(std::lround(std::sqrt(cells)))); }

}  // namespace

Mesh bumpy_sphere(int triangles) {
  Mesh mesh;
  const int rows = side(triangles / 4.0);
  add_grid(mesh, rows, 2 * rows, [](double u, double v) {
    const double a = kPi * v, b = 2 * kPi * u;
    const double radius = 1 + 0.05 * std::sin(23 * a) * std::sin(17 * b) * std::sin(a);
    return radius * glm::dvec3(std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b));
  });
  return mesh;
}

Mesh column_hall(int triangles) {
  constexpr int kAlong = 12, kAcross = 4;
  Mesh mesh;
  // Nine tenths of the triangles are the columns'.
  const int around = side(0.9 * triangles / (2.0 * kAlong * kAcross));
  for (int i = 0; i < kAlong; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const double x = 4 * (i + 0.5) / kAlong - 2, z = 2 * (k + 0.5) / kAcross - 1;
      add_grid(mesh, around, around, [&](double u, double v) {
        const double angle = 2 * kPi * u;
        const double foot = 1 + 0.5 * std::exp(-20 * v) + 0.5 * std::exp(-20 * (1 - v));
        const double radius = 0.06 * foot * (1 + 0.06 * std::cos(16 * angle));
        return glm::dvec3(x + radius * std::cos(angle), v - 0.5, z - radius * std::sin(angle));
      });
    }
  }
  const int cells = side(0.1 * triangles / 12.0);
  const auto wall = [&](glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v) {
    add_grid(mesh, cells, cells, [&](double a, double b) { return corner + a * u + b * v; });
  };
  const glm::dvec3 x(4, 0, 0), y(0, 1, 0), z(0, 0, 2), low(-2, -0.5, -1);
  wall(low, z, x);
  wall(low + y, x, z);
  wall(low, x, y);
  wall(low + z, y, x);
  wall(low, y, z);
  wall(low + x, z, y);
  return mesh;
}

}  // namespace lightbench::micro
