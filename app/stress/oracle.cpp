#include "app/stress/oracle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "core/error.h"

namespace lightbench::stress {
namespace {

using glm::cross;
using glm::dot;
using glm::length;
using glm::normalize;

constexpr Number kInfinite = std::numeric_limits<Number>::infinity();

/// Outward half-space n.p <= offset.
struct HalfSpace {
  V n;
  Number offset;
};

std::vector<HalfSpace> faces_of(const BoxShape& s) {
  std::vector<HalfSpace> faces;
  for (int k = 0; k < 3; ++k) {
    V n(0);
    n[k] = 1;
    faces.push_back({n, static_cast<Number>(s.max[k])});
    faces.push_back({-n, -static_cast<Number>(s.min[k])});
  }
  return faces;
}

std::vector<HalfSpace> faces_of(const PyramidShape& s) {
  std::vector<HalfSpace> faces;
  for (std::size_t i = 0; i < 4; ++i) {
    const V a(s.vertices[(i + 1) % 4]), b(s.vertices[(i + 2) % 4]), c(s.vertices[(i + 3) % 4]);
    V n = normalize(cross(b - a, c - a));
    if (dot(n, V(s.vertices[i]) - a) > 0) n = -n;
    faces.push_back({n, dot(n, a)});
  }
  return faces;
}

Span clip(const std::vector<HalfSpace>& faces, const OracleRay& ray, Number grow) {
  Span s{true, -kInfinite, kInfinite};
  for (const HalfSpace& f : faces) {
    const Number slope = dot(f.n, ray.d), height = dot(f.n, ray.o) - f.offset - grow;
    if (slope == 0) {
      if (height > 0) return {};
    } else if (slope < 0) {
      s.near = std::max(s.near, -height / slope);
    } else {
      s.far = std::min(s.far, -height / slope);
    }
  }
  s.hit = s.near < s.far;
  return s;
}

const HalfSpace& nearest_face(const std::vector<HalfSpace>& faces, const V& p) {
  return *std::max_element(faces.begin(), faces.end(), [&](const auto& a, const auto& b) {
    return dot(a.n, p) - a.offset < dot(b.n, p) - b.offset;
  });
}

/// Middle of the chord that the line o + t d has in a circle or sphere around 0, and its offset.
/// Two steps: the first leaves rounding along d only.
struct Approach {
  Number t;
  V p;
};
Approach approach(const V& o, const V& d, Number dd) {
  const Number t = -dot(o, d) / dd;
  const V p = o + t * d;
  const Number step = -dot(p, d) / dd;
  return {t + step, p + step * d};
}

struct Frame {
  V middle, axis;
  Number half;
};
Frame frame_of(const CylinderShape& s) {
  const V p0(s.p0), p1(s.p1);
  return {(p0 + p1) / Number(2), normalize(p1 - p0), length(p1 - p0) / 2};
}

Span span_of(const SphereShape& s, const OracleRay& ray, Number grow) {
  const Number dd = dot(ray.d, ray.d), r = static_cast<Number>(s.radius) + grow;
  const Approach a = approach(ray.o - V(s.center), ray.d, dd);
  const Number rest = r * r - dot(a.p, a.p);
  if (r <= 0 || rest <= 0) return {};
  const Number h = std::sqrt(rest / dd);
  return {true, a.t - h, a.t + h};
}

Span span_of(const CylinderShape& s, const OracleRay& ray, Number grow) {
  const Frame c = frame_of(s);
  const Number r = static_cast<Number>(s.radius) + grow, half = c.half + grow;
  if (r <= 0 || half <= 0) return {};
  const V f = ray.o - c.middle;
  const Number dz = dot(ray.d, c.axis), fz = dot(f, c.axis);
  const V dp = ray.d - dz * c.axis, fp = f - fz * c.axis;
  const Number dd = dot(dp, dp);
  Span span{true, -kInfinite, kInfinite};
  // Rounding of the components leaves this much of a ray along the axis.
  if (dd < Number(1e-36)) {
    if (dot(fp, fp) >= r * r) return {};
  } else {
    const Approach a = approach(fp, dp, dd);
    const Number rest = r * r - dot(a.p, a.p);
    if (rest <= 0) return {};
    const Number h = std::sqrt(rest / dd);
    span = {true, a.t - h, a.t + h};
  }
  if (dz == 0) {
    if (std::abs(fz) >= half) return {};
  } else {
    const Number t0 = (-half - fz) / dz, t1 = (half - fz) / dz;
    span.near = std::max(span.near, std::min(t0, t1));
    span.far = std::min(span.far, std::max(t0, t1));
  }
  span.hit = span.near < span.far;
  return span;
}

[[noreturn]] void not_solid() { throw Error(ErrorKind::Internal, "stress: a solid expected"); }

/// Plane and border of a flat shape.
struct Plane {
  V point, n;
};
Plane plane_of(const DiscShape& s) { return {V(s.center), normalize(V(s.normal))}; }
Plane plane_of(const RectangleShape& s) {
  return {V(s.corner), normalize(cross(V(s.edge_u), V(s.edge_v)))};
}
Plane plane_of(const TriangleShape& s) {
  return {V(s.a), normalize(cross(V(s.b) - V(s.a), V(s.c) - V(s.a)))};
}

Number inside_of(const DiscShape& s, const V& p, const V&) {
  return static_cast<Number>(s.radius) - length(p - V(s.center));
}
template <std::size_t kCount>
Number inside_polygon(const std::array<V, kCount>& corners, const V& p, const V& n) {
  Number inside = kInfinite;
  for (std::size_t i = 0; i < kCount; ++i) {
    const V edge = corners[(i + 1) % kCount] - corners[i];
    inside = std::min(inside, dot(cross(n, edge), p - corners[i]) / length(edge));
  }
  return inside;
}
Number inside_of(const RectangleShape& s, const V& p, const V& n) {
  const V a(s.corner), u(s.edge_u), v(s.edge_v);
  return inside_polygon(std::array<V, 4>{a, a + u, a + u + v, a + v}, p, n);
}
Number inside_of(const TriangleShape& s, const V& p, const V& n) {
  return inside_polygon(std::array<V, 3>{V(s.a), V(s.b), V(s.c)}, p, n);
}

template <class F>
auto with_flat(const Shape& shape, F f) {
  if (const auto* disc = std::get_if<DiscShape>(&shape)) return f(*disc);
  if (const auto* rectangle = std::get_if<RectangleShape>(&shape)) return f(*rectangle);
  return f(std::get<TriangleShape>(shape));
}

}  // namespace

OracleRay exact_ray(const RenderScene& scene, const Ray& ray) {
  const Ray seen = as_traced(scene, ray);
  return {V(seen.origin) + V(seen.origin_remainder), V(seen.direction)};
}

OracleRay into_object(const OracleRay& ray, const Matrix& world_to_object) {
  return {V(world_to_object * glm::vec<4, Number>(ray.o, 1)),
          V(world_to_object * glm::vec<4, Number>(ray.d, 0))};
}

V exact_position(const Hit& hit) { return V(hit.position) + V(hit.position_remainder); }

Number told_distance(const Ray& ray, const Hit& hit) {
  return static_cast<Number>(hit.t) * glm::length(V(ray.direction));
}

Span solid_span(const Shape& shape, const OracleRay& ray, Number grow) {
  if (const auto* s = std::get_if<SphereShape>(&shape)) return span_of(*s, ray, grow);
  if (const auto* s = std::get_if<CylinderShape>(&shape)) return span_of(*s, ray, grow);
  if (const auto* s = std::get_if<BoxShape>(&shape)) return clip(faces_of(*s), ray, grow);
  if (const auto* s = std::get_if<PyramidShape>(&shape)) return clip(faces_of(*s), ray, grow);
  not_solid();
}

Number outside_of(const Shape& shape, const V& p) {
  if (const auto* s = std::get_if<SphereShape>(&shape)) {
    return length(p - V(s->center)) - static_cast<Number>(s->radius);
  }
  if (const auto* s = std::get_if<CylinderShape>(&shape)) {
    const Frame c = frame_of(*s);
    const Number z = dot(p - c.middle, c.axis);
    const Number rho = length(p - c.middle - z * c.axis);
    return std::max(std::abs(z) - c.half, rho - static_cast<Number>(s->radius));
  }
  const auto faces = std::holds_alternative<BoxShape>(shape)
                         ? faces_of(std::get<BoxShape>(shape))
                         : faces_of(std::get<PyramidShape>(shape));
  const HalfSpace& face = nearest_face(faces, p);
  return dot(face.n, p) - face.offset;
}

Number off_face(const Shape& shape, const V& p, const V& n) {
  if (const auto* s = std::get_if<CylinderShape>(&shape)) {
    const Frame c = frame_of(*s);
    const Number z = dot(p - c.middle, c.axis);
    const bool cap = std::abs(dot(n, c.axis)) > Number(0.5);
    return cap ? std::abs(z) - c.half
               : length(p - c.middle - z * c.axis) - static_cast<Number>(s->radius);
  }
  if (std::holds_alternative<SphereShape>(shape)) return outside_of(shape, p);
  const bool box = std::holds_alternative<BoxShape>(shape);
  if (!box && !std::holds_alternative<PyramidShape>(shape)) return off_plane(shape, p);
  const auto faces =
      box ? faces_of(std::get<BoxShape>(shape)) : faces_of(std::get<PyramidShape>(shape));
  const HalfSpace& face =
      *std::max_element(faces.begin(), faces.end(),
                        [&](const auto& a, const auto& b) { return dot(a.n, n) < dot(b.n, n); });
  return dot(face.n, p) - face.offset;
}

V solid_normal(const Shape& shape, const V& p) {
  if (const auto* s = std::get_if<SphereShape>(&shape)) return normalize(p - V(s->center));
  if (const auto* s = std::get_if<CylinderShape>(&shape)) {
    const Frame c = frame_of(*s);
    const Number z = dot(p - c.middle, c.axis);
    const V across = p - c.middle - z * c.axis;
    const bool cap = std::abs(z) - c.half > length(across) - static_cast<Number>(s->radius);
    return cap ? c.axis * std::copysign(Number(1), z) : normalize(across);
  }
  const auto faces = std::holds_alternative<BoxShape>(shape)
                         ? faces_of(std::get<BoxShape>(shape))
                         : faces_of(std::get<PyramidShape>(shape));
  return nearest_face(faces, p).n;
}

PlanePoint flat_point(const Shape& shape, const OracleRay& ray) {
  return with_flat(shape, [&](const auto& s) {
    const Plane plane = plane_of(s);
    const Number t = dot(plane.n, plane.point - ray.o) / dot(plane.n, ray.d);
    return PlanePoint{t, inside_of(s, ray.o + t * ray.d, plane.n), plane.n};
  });
}

Number off_plane(const Shape& shape, const V& p) {
  return with_flat(shape, [&](const auto& s) {
    const Plane plane = plane_of(s);
    return dot(plane.n, p - plane.point);
  });
}

std::string to_text(const glm::dvec3& v) {
  return fmt::format("[{:.17g},{:.17g},{:.17g}]", v.x, v.y, v.z);
}

std::string to_text(const Ray& ray) {
  std::string text =
      fmt::format(R"({{"o":{},"d":{}}})", to_text(ray.origin), to_text(ray.direction));
  if (ray.origin_remainder != glm::dvec3(0)) text += " and " + to_text(ray.origin_remainder);
  return text;
}

std::string to_text(const Shape& shape) {
  struct Text {
    std::string operator()(const SphereShape& s) const {
      return fmt::format("sphere {} radius {:.17g}", to_text(s.center), s.radius);
    }
    std::string operator()(const CylinderShape& s) const {
      return fmt::format("cylinder {} {} radius {:.17g}", to_text(s.p0), to_text(s.p1), s.radius);
    }
    std::string operator()(const DiscShape& s) const {
      return fmt::format("disc {} normal {} radius {:.17g}", to_text(s.center), to_text(s.normal),
                         s.radius);
    }
    std::string operator()(const RectangleShape& s) const {
      return fmt::format("rectangle {} edges {} {}", to_text(s.corner), to_text(s.edge_u),
                         to_text(s.edge_v));
    }
    std::string operator()(const TriangleShape& s) const {
      return fmt::format("triangle {} {} {}", to_text(s.a), to_text(s.b), to_text(s.c));
    }
    std::string operator()(const PyramidShape& s) const {
      return fmt::format("pyramid {} {} {} {}", to_text(s.vertices[0]), to_text(s.vertices[1]),
                         to_text(s.vertices[2]), to_text(s.vertices[3]));
    }
    std::string operator()(const BoxShape& s) const {
      return fmt::format("box {} {}", to_text(s.min), to_text(s.max));
    }
    std::string operator()(const MeshShape&) const { return "mesh"; }
  };
  return std::visit(Text{}, shape);
}

}  // namespace lightbench::stress
