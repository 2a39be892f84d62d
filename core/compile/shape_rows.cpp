#include "core/compile/shape_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace lightbench {
namespace {

using glm::cross;
using glm::dmat3;
using glm::dmat4;
using glm::dot;
using glm::dvec3;
using glm::length;
using glm::normalize;
constexpr double kPi = std::numbers::pi;

void append(std::vector<double>& row, const dvec3& v) { row.insert(row.end(), {v.x, v.y, v.z}); }

/// A map with what the shapes ask of it.
struct Map {
  dmat4 matrix;
  dmat3 linear;
  double determinant;
  explicit Map(const dmat4& m) : matrix(m), linear(m), determinant(glm::determinant(linear)) {}
  [[nodiscard]] dvec3 point(const dvec3& p) const { return dvec3(matrix * glm::dvec4(p, 1)); }
  [[nodiscard]] dvec3 vector(const dvec3& v) const { return linear * v; }
  [[nodiscard]] dvec3 normal(const dvec3& n) const {
    return normalize(glm::inverseTranspose(linear) * n);
  }
  /// The factor if the map is a rotation with a uniform positive scale, else 0.
  [[nodiscard]] double similarity() const {
    const double x = length(linear[0]), y = length(linear[1]), z = length(linear[2]);
    const double largest = std::max({x, y, z}), smallest = std::min({x, y, z});
    return determinant > 0 && largest - smallest <= 1e-12 * largest ? (x + y + z) / 3 : 0;
  }
};

/// a b - c d to one and a half units in the last place (Kahan; Jeannerod et al. 2013).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

/// Perpendicular to both to the last bits even where they are nearly parallel: the rounding of
/// plain products would tilt the plane of a sliver along its length.
dvec3 normal_of(const dvec3& a, const dvec3& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

dvec3 perpendicular(const dvec3& unit) {
  const dvec3 helper = std::abs(unit.x) > 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  return normalize(cross(helper, unit));
}

/// Knud Thomsen's approximation, within 1.1 %: only the choice among lights depends on it.
double ellipsoid_area(const dmat3& m) {
  const double p = 1.6075;
  const double a = std::pow(length(m[0]), p), b = std::pow(length(m[1]), p),
               c = std::pow(length(m[2]), p);
  return 4 * kPi * std::pow((a * b + b * c + c * a) / 3, 1 / p);
}

/// Axes (unit, the longest first) and squared semi-axes of the unit sphere's image under m, by
/// one-sided Jacobi rotations (Hestenes 1958): they turn m's columns until those are perpendicular.
/// As eigenvalues of m m^T the short axes would drown in the rounding of the long ones.
void append_principal_axes(std::vector<double>& row, dmat3 m) {
  for (int sweep = 0; sweep < 12; ++sweep) {
    for (int p = 0; p < 2; ++p) {
      for (int q = p + 1; q < 3; ++q) {
        const double pp = dot(m[p], m[p]), qq = dot(m[q], m[q]), pq = dot(m[p], m[q]);
        if (std::abs(pq) <= 1e-16 * std::sqrt(pp) * std::sqrt(qq)) continue;
        const double zeta = (qq - pp) / (2 * pq);
        const double tangent =
            std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
        const double cosine = 1 / std::sqrt(1 + tangent * tangent), sine = cosine * tangent;
        const dvec3 turned = cosine * m[p] - sine * m[q];
        m[q] = sine * m[p] + cosine * m[q];
        m[p] = turned;
      }
    }
  }
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int i, int k) { return dot(m[i], m[i]) > dot(m[k], m[k]); });
  for (const int i : order) append(row, normalize(m[i]));
  for (const int i : order) row.push_back(dot(m[i], m[i]));
}

ShapeRow row_of(const SphereShape& s, const Map& map, double open, double close) {
  ShapeRow r;
  const dvec3 center = map.point(s.center + open * s.motion);
  const dvec3 motion = map.vector((close - open) * s.motion);
  if (const double factor = map.similarity(); factor > 0) {
    r.kind = PrimitiveKind::Sphere;
    append(r.numbers, center);
    r.numbers.push_back(factor * s.radius);
    append(r.numbers, motion);
    append(r.numbers, normalize(map.linear[1]));
    append(r.numbers, normalize(map.linear[0]));
    r.area = 4 * kPi * factor * factor * s.radius * s.radius;
    return r;
  }
  r.kind = PrimitiveKind::Ellipsoid;
  dmat4 unit(map.linear * s.radius);
  unit[3] = glm::dvec4(center, 1);
  append_affine(r.numbers, glm::inverse(unit));
  append_affine(r.numbers, unit);
  append(r.numbers, motion);
  append_principal_axes(r.numbers, dmat3(unit));
  r.area = ellipsoid_area(dmat3(unit));
  return r;
}

ShapeRow row_of(const CylinderShape& s, const Map& map) {
  ShapeRow r;
  const dvec3 axis = normalize(s.p1 - s.p0);
  const dvec3 meridian = perpendicular(axis);
  const dvec3 middle = 0.5 * (s.p0 + s.p1);
  const double half = 0.5 * length(s.p1 - s.p0);
  if (const double factor = map.similarity(); factor > 0) {
    r.kind = PrimitiveKind::Cylinder;
    append(r.numbers, map.point(middle));
    append(r.numbers, normalize(map.vector(axis)));
    append(r.numbers, normalize(map.vector(meridian)));
    r.numbers.push_back(factor * half);
    r.numbers.push_back(factor * s.radius);
    r.area = 2 * kPi * factor * factor * s.radius * (s.radius + 2 * half);
    return r;
  }
  r.kind = PrimitiveKind::EllipticCylinder;
  const dmat3 frame =
      map.linear * dmat3(meridian * s.radius, axis * half, cross(meridian, axis) * s.radius);
  dmat4 unit(frame);
  unit[3] = glm::dvec4(map.point(middle), 1);
  append_affine(r.numbers, glm::inverse(unit));
  append_affine(r.numbers, unit);
  r.numbers.push_back(std::abs(glm::determinant(frame)));
  const double x = length(frame[0]), y = length(frame[1]), z = length(frame[2]);
  r.area = 2 * kPi * x * z + 2 * kPi * std::sqrt(0.5 * (x * x + z * z)) * 2 * y;
  return r;
}

ShapeRow row_of(const DiscShape& s, const Map& map) {
  ShapeRow r;
  r.kind = PrimitiveKind::Disc;
  const dvec3 n = normalize(s.normal);
  const dvec3 u = perpendicular(n);
  dvec3 a = map.vector(u * s.radius), b = map.vector(cross(n, u) * s.radius);
  // Principal axes of the ellipse that a and b span.
  const double skew = dot(a, b);
  if (std::abs(skew) > 1e-12 * (dot(a, a) + dot(b, b))) {
    const double angle = 0.5 * std::atan2(2 * skew, dot(a, a) - dot(b, b));
    const dvec3 c = std::cos(angle) * a + std::sin(angle) * b;
    b = -std::sin(angle) * a + std::cos(angle) * b;
    a = c;
  }
  // A circle stays one: as an ellipse its axes would be those of the rounding, and the same scene
  // in other units would take other samples.
  const double aa = dot(a, a), bb = dot(b, b);
  if (std::abs(aa - bb) <= 1e-12 * (aa + bb)) b *= std::sqrt(aa / bb);
  const dvec3 normal = map.normal(n);
  if (dot(cross(a, b), normal) < 0) b = -b;
  append(r.numbers, map.point(s.center));
  append(r.numbers, normal);
  append(r.numbers, a);
  append(r.numbers, b);
  append(r.numbers, a / dot(a, a));
  append(r.numbers, b / dot(b, b));
  r.area = kPi * length(a) * length(b);
  return r;
}

ShapeRow row_of(const RectangleShape& s, const Map& map) {
  ShapeRow r;
  r.kind = PrimitiveKind::Rectangle;
  const dvec3 u = map.vector(s.edge_u), v = map.vector(s.edge_v);
  const dvec3 n = cross(u, v);
  append(r.numbers, map.point(s.corner));
  append(r.numbers, map.normal(normal_of(s.edge_u, s.edge_v)));
  append(r.numbers, u);
  append(r.numbers, v);
  append(r.numbers, cross(v, n) / dot(u, cross(v, n)));
  append(r.numbers, cross(n, u) / dot(v, cross(n, u)));
  r.area = length(n);
  return r;
}

ShapeRow row_of(const TriangleShape& s, const Map& map) {
  ShapeRow r;
  r.kind = PrimitiveKind::Triangle;
  const dvec3 a = map.point(s.a), b = map.point(s.b), c = map.point(s.c);
  for (const dvec3& v : {a, b, c}) append(r.numbers, v);
  r.numbers.push_back(map.determinant > 0 ? 1 : -1);
  r.area = 0.5 * length(cross(b - a, c - a));
  return r;
}

ShapeRow row_of(const PyramidShape& s, const Map& map) {
  ShapeRow r;
  r.kind = PrimitiveKind::Pyramid;
  dvec3 v[4];
  for (std::size_t i = 0; i < 4; ++i) v[i] = map.point(s.vertices[i]);
  dvec3 a = v[1] - v[0], b = v[2] - v[0], c = v[3] - v[0];
  if (dot(a, cross(b, c)) < 0) std::swap(b, c);
  const dvec3 face[4] = {normal_of(b - a, c - a), normal_of(c, b), normal_of(a, c),
                         normal_of(b, a)};
  append(r.numbers, v[0]);
  append(r.numbers, a);
  append(r.numbers, b);
  append(r.numbers, c);
  for (const dvec3& n : face) {
    append(r.numbers, normalize(n));
    r.area += 0.5 * length(n);
  }
  r.numbers.push_back(dot(normalize(face[0]), a));
  return r;
}

ShapeRow row_of(const BoxShape& s, const Map& map) {
  ShapeRow r;
  r.kind = PrimitiveKind::Box;
  const dvec3 half = 0.5 * (s.max - s.min);
  append(r.numbers, map.point(0.5 * (s.min + s.max)));
  dvec3 extent;
  for (int k = 0; k < 3; ++k) {
    extent[k] = half[k] * length(map.linear[k]);
    append(r.numbers, normalize(map.linear[k]));
  }
  append(r.numbers, extent);
  r.area = 8 * (extent.x * extent.y + extent.y * extent.z + extent.z * extent.x);
  return r;
}

}  // namespace

void append_affine(std::vector<double>& row, const glm::dmat4& matrix) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) row.push_back(matrix[k][i]);
  }
}

ShapeRow make_shape_row(const Shape& shape, const glm::dmat4& matrix, double shutter_open,
                        double shutter_close) {
  const Map map(matrix);
  return std::visit(
      [&](const auto& s) -> ShapeRow {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, SphereShape>) {
          return row_of(s, map, shutter_open, shutter_close);
        } else if constexpr (std::is_same_v<S, MeshShape>) {
          return {};
        } else {
          return row_of(s, map);
        }
      },
      shape);
}

}  // namespace lightbench
