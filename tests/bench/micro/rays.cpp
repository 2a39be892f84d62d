#include "tests/bench/micro/rays.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "core/scene/bounds.h"

namespace lightbench::micro {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr std::size_t kMultiple = 16;

struct Random {
  std::mt19937_64 engine{1};
  double operator()(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  glm::dvec3 direction() {
    const double z = (*this)(-1, 1), angle = (*this)(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
};

void add(RaySet& rays, const glm::dvec3& o, const glm::dvec3& d, float t_max) {
  for (int k = 0; k < 3; ++k) {
    rays.o[static_cast<std::size_t>(k)].push_back(static_cast<float>(o[k]));
    rays.d[static_cast<std::size_t>(k)].push_back(static_cast<float>(d[k]));
  }
  rays.t_max.push_back(t_max);
}

RaySet padded(RaySet rays) {
  rays.size = rays.t_max.size();
  while (rays.t_max.size() % kMultiple != 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      rays.o[k].push_back(rays.o[k][0]);
      rays.d[k].push_back(rays.d[k][0]);
    }
    rays.t_max.push_back(rays.t_max[0]);
  }
  return rays;
}

struct SurfacePoint {
  glm::dvec3 p, n;
};

/// A random point of a random triangle, a ten-thousandth of the mesh's size off its front.
SurfacePoint surface_point(const Mesh& mesh, const Bounds& bounds, Random& random) {
  for (;;) {
    const auto& t = mesh.triangles[random.engine() % mesh.triangles.size()];
    const glm::dvec3 a = mesh.positions[t[0]], e1 = mesh.positions[t[1]] - a,
                     e2 = mesh.positions[t[2]] - a;
    double u = random(), v = random();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 n = glm::cross(e1, e2);
    if (!(glm::length(n) > 0)) continue;
    const glm::dvec3 unit = glm::normalize(n);
    return {a + u * e1 + v * e2 + 1e-4 * glm::length(bounds.size()) * unit, unit};
  }
}

}  // namespace

RaySet bounces(const Mesh& mesh, std::size_t count) {
  const Bounds bounds = mesh_bounds(mesh);
  Random random;
  RaySet rays;
  while (rays.t_max.size() < count) {
    const SurfacePoint s = surface_point(mesh, bounds, random);
    const glm::dvec3 d = s.n + random.direction();
    if (glm::length(d) > 1e-6) add(rays, s.p, glm::normalize(d), kInf);
  }
  return padded(std::move(rays));
}

namespace {

RaySet chords_of(const glm::dvec3& center, double radius, std::size_t count) {
  Random random;
  RaySet rays;
  while (rays.t_max.size() < count) {
    const glm::dvec3 a = random.direction(), b = random.direction();
    add(rays, center + radius * a, glm::normalize(b - a), kInf);
  }
  return padded(std::move(rays));
}

}  // namespace

RaySet chords(const Mesh& mesh, std::size_t count) {
  const Bounds bounds = mesh_bounds(mesh);
  return chords_of(bounds.center(), glm::length(bounds.size()) / 2, count);
}

RaySet chords_of_ball(double radius, std::size_t count) {
  return chords_of(glm::dvec3(0), radius, count);
}

RaySet segments(const Mesh& mesh, std::size_t count) {
  const Bounds bounds = mesh_bounds(mesh);
  Random random;
  RaySet rays;
  while (rays.t_max.size() < count) {
    const SurfacePoint s = surface_point(mesh, bounds, random);
    const glm::dvec3 to = bounds.min + bounds.size() * glm::dvec3(random(), random(), random());
    const glm::dvec3 way = to - s.p;
    if (!(glm::dot(way, s.n) > 0)) continue;
    add(rays, s.p, glm::normalize(way), static_cast<float>(glm::length(way)));
  }
  return padded(std::move(rays));
}

}  // namespace lightbench::micro
