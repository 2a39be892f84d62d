#include "app/stress/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench::stress {
namespace {

using glm::dvec3;

dvec3 on_grid(const dvec3& v) {
  return {std::round(v.x * 1024) / 1024, std::round(v.y * 1024) / 1024,
          std::round(v.z * 1024) / 1024};
}

PyramidShape random_pyramid(Random& random) {
  for (;;) {
    PyramidShape s;
    for (dvec3& v : s.vertices) v = on_grid(random.direction());
    const auto& v = s.vertices;
    const double volume6 = glm::dot(v[1] - v[0], glm::cross(v[2] - v[0], v[3] - v[0]));
    if (std::abs(volume6) > 0.3) return s;
  }
}

TriangleShape random_triangle(Random& random) {
  for (;;) {
    const TriangleShape s{on_grid(random.direction()), on_grid(random.direction()),
                          on_grid(random.direction())};
    if (glm::length(glm::cross(s.b - s.a, s.c - s.a)) > 0.3) return s;
  }
}

dvec3 on_circle(Random& random, const dvec3& n, double radius) { return radius * random.across(n); }

struct RandomPoint {
  Random& random;
  dvec3 operator()(const SphereShape& s) const {
    return s.center + s.radius * std::cbrt(random.unit()) * random.direction();
  }
  dvec3 operator()(const CylinderShape& s) const {
    const dvec3 axis = s.p1 - s.p0;
    return s.p0 + random.unit() * axis +
           on_circle(random, glm::normalize(axis), s.radius * std::sqrt(random.unit()));
  }
  dvec3 operator()(const DiscShape& s) const {
    return s.center +
           on_circle(random, glm::normalize(s.normal), s.radius * std::sqrt(random.unit()));
  }
  dvec3 operator()(const RectangleShape& s) const {
    const double a = random.unit();
    return s.corner + a * s.edge_u + random.unit() * s.edge_v;
  }
  dvec3 operator()(const TriangleShape& s) const {
    const double r = std::sqrt(random.unit());
    return s.a + (1 - r) * (s.b - s.a) + (r * random.unit()) * (s.c - s.a);
  }
  dvec3 operator()(const PyramidShape& s) const {
    std::array<double, 4> w{};
    double sum = 0;
    for (double& x : w) sum += x = -std::log(1 - random.unit());
    dvec3 p(0);
    for (std::size_t i = 0; i < 4; ++i) p += (w[i] / sum) * s.vertices[i];
    return p;
  }
  dvec3 operator()(const BoxShape& s) const {
    return s.min + (random.in_cube(0.5) + 0.5) * (s.max - s.min);
  }
  dvec3 operator()(const MeshShape&) const { return dvec3(0); }
};

struct RandomEnd {
  Random& random;
  /// A corner, or a point of the edge between two.
  template <std::size_t kCount>
  dvec3 between(const std::array<dvec3, kCount>& corners, std::size_t a, std::size_t b) const {
    const dvec3 p = corners[a % kCount], q = corners[b % kCount];
    return random.chance(0.5) ? p : p + random.unit() * (q - p);
  }
  std::size_t below(std::size_t count) const {
    return static_cast<std::size_t>(random.below(static_cast<int>(count)));
  }

  dvec3 operator()(const SphereShape& s) const { return s.center + s.radius * random.direction(); }
  dvec3 operator()(const CylinderShape& s) const {
    return (random.chance(0.5) ? s.p0 : s.p1) +
           on_circle(random, glm::normalize(s.p1 - s.p0), s.radius);
  }
  dvec3 operator()(const DiscShape& s) const {
    return s.center + on_circle(random, glm::normalize(s.normal), s.radius);
  }
  dvec3 operator()(const RectangleShape& s) const {
    const dvec3 far = s.corner + s.edge_u + s.edge_v;
    const std::size_t k = below(4);
    return between<4>({s.corner, s.corner + s.edge_u, far, s.corner + s.edge_v}, k, k + 1);
  }
  dvec3 operator()(const TriangleShape& s) const {
    const std::size_t k = below(3);
    return between<3>({s.a, s.b, s.c}, k, k + 1);
  }
  dvec3 operator()(const PyramidShape& s) const {
    const std::size_t k = below(4);
    return between<4>(s.vertices, k, k + 1 + below(3));
  }
  dvec3 operator()(const BoxShape& s) const {
    dvec3 p;
    for (int k = 0; k < 3; ++k) p[k] = random.chance(0.5) ? s.min[k] : s.max[k];
    const int free = random.below(3);
    if (random.chance(0.5)) p[free] = random.between(s.min[free], s.max[free]);
    return p;
  }
  dvec3 operator()(const MeshShape&) const { return dvec3(0); }
};

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::Sphere:
      return "sphere";
    case Kind::Cylinder:
      return "cylinder";
    case Kind::Pyramid:
      return "pyramid";
    case Kind::Box:
      return "box";
    case Kind::Disc:
      return "disc";
    case Kind::Rectangle:
      return "rectangle";
    case Kind::Triangle:
      return "triangle";
    case Kind::Mesh:
      break;
  }
  return "mesh";
}

bool is_solid(Kind kind) { return kind <= Kind::Box; }

Shape random_shape(Random& random, Kind kind) {
  switch (kind) {
    case Kind::Sphere:
      return SphereShape{.center = dvec3(0), .radius = 1, .motion = dvec3(0)};
    case Kind::Cylinder: {
      const dvec3 half = on_grid(random.direction() * random.between(0.3, 1));
      return CylinderShape{-half, half, on_grid(dvec3(random.between(0.2, 1))).x};
    }
    case Kind::Pyramid:
      return random_pyramid(random);
    case Kind::Box: {
      const dvec3 half = on_grid(random.in_cube(0.4) + 0.6);
      return BoxShape{-half, half};
    }
    case Kind::Disc:
      return DiscShape{dvec3(0), random.direction(), 1};
    case Kind::Rectangle: {
      const dvec3 u = random.direction();
      const dvec3 v =
          on_grid(random.between(0.3, 1.5) * random.across(u) + random.between(-0.3, 0.3) * u);
      return RectangleShape{-on_grid(u), 2.0 * on_grid(u), v};
    }
    case Kind::Triangle:
    case Kind::Mesh:
      break;
  }
  return random_triangle(random);
}

Shape random_flat_solid(Random& random, Kind kind) {
  if (kind == Kind::Box) {
    dvec3 half = on_grid(random.in_cube(0.4) + 0.6);
    half[random.below(3)] = 0x1p-10;
    return BoxShape{-half, half};
  }
  for (;;) {
    const TriangleShape base = random_triangle(random);
    const dvec3 u = base.b - base.a, v = base.c - base.a;
    const double s = random.between(-1, 2);
    // The grid keeps the fourth corner out of the others' plane.
    const dvec3 top = on_grid(base.a + s * u + random.between(-1, 2) * v);
    const dvec3 n = glm::cross(u, v);
    const double height = std::abs(glm::dot(top - base.a, n)) / glm::length(n);
    if (height > 1e-4) return PyramidShape{{base.a, base.b, base.c, top}};
  }
}

Mesh cube_mesh(double half) {
  Mesh mesh;
  for (unsigned k = 0; k < 8; ++k) {
    mesh.positions.push_back(
        half * dvec3((k & 1U) != 0 ? 1 : -1, (k & 2U) != 0 ? 1 : -1, (k & 4U) != 0 ? 1 : -1));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

dvec3 random_point(Random& random, const Shape& shape) {
  return std::visit(RandomPoint{random}, shape);
}

dvec3 random_end(Random& random, const Shape& shape) {
  return std::visit(RandomEnd{random}, shape);
}

}  // namespace lightbench::stress
