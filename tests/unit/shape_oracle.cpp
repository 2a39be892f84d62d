#include "tests/unit/shape_oracle.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench {
namespace {

using Number = long double;
using V = glm::vec<3, Number>;
constexpr Number kPi = std::numbers::pi_v<Number>;

class Oracle {
 public:
  Oracle(const V& origin, const V& direction) : o_(origin), d_(direction) {}

  [[nodiscard]] std::optional<OracleHit> best() const { return best_; }
  [[nodiscard]] V at(Number t) const { return o_ + t * d_; }

  void report(Number t, const V& normal, Number u, Number v, bool has_u = true, bool has_v = true) {
    if (!(t > 0) || (best_ && static_cast<Number>(best_->t) <= t)) return;
    best_ = OracleHit{static_cast<double>(t),
                      glm::dvec3(at(t)),
                      glm::dvec3(glm::normalize(normal)),
                      static_cast<double>(u),
                      static_cast<double>(v),
                      has_u,
                      has_v};
  }

  /// Roots of a t^2 + 2 b t + c.
  template <class F>
  static void roots(Number a, Number b, Number c, F f) {
    const Number discriminant = b * b - a * c;
    if (a == 0 || discriminant <= 0) return;
    const Number q = -(b + std::copysign(std::sqrt(discriminant), b));
    f(q / a);
    if (q != 0) f(c / q);
  }

  /// Calls f(t, x, y) for the hit with the plane p + x e1 + y e2.
  template <class F>
  void plane(const V& p, const V& e1, const V& e2, F f) const {
    const V n = glm::cross(e1, e2);
    const Number slope = glm::dot(n, d_);
    if (slope == 0) return;
    const Number t = glm::dot(n, p - o_) / slope;
    const V q = at(t) - p;
    const Number nn = glm::dot(n, n);
    f(t, glm::dot(glm::cross(q, e2), n) / nn, glm::dot(glm::cross(e1, q), n) / nn);
  }

  void triangle(const V& a, const V& b, const V& c, const V& outward, const glm::dvec2* uv,
                bool has_uv) {
    plane(a, b - a, c - a, [&](Number t, Number x, Number y) {
      if (x < 0 || y < 0 || x + y > 1) return;
      if (uv == nullptr) return report(t, outward, x, y, has_uv, has_uv);
      const Number rest = 1 - x - y;
      report(t, outward,
             rest * static_cast<Number>(uv[0].x) + x * static_cast<Number>(uv[1].x) +
                 y * static_cast<Number>(uv[2].x),
             rest * static_cast<Number>(uv[0].y) + x * static_cast<Number>(uv[1].y) +
                 y * static_cast<Number>(uv[2].y));
    });
  }

  const V& d() const { return d_; }
  const V& o() const { return o_; }

 private:
  V o_, d_;
  std::optional<OracleHit> best_;
};

void trace(Oracle& ray, const SphereShape& s, double time) {
  const V center = V(s.center) + static_cast<Number>(time) * V(s.motion);
  const V f = ray.o() - center;
  const auto r = static_cast<Number>(s.radius);
  Oracle::roots(
      glm::dot(ray.d(), ray.d()), glm::dot(f, ray.d()), glm::dot(f, f) - r * r, [&](Number t) {
        const V n = (ray.at(t) - center) / r;
        // As the books define them.
        const Number cosine = std::fmax(-1.0L, std::fmin(1.0L, -n.y));
        ray.report(t, n, (std::atan2(-n.z, n.x) + kPi) / (2 * kPi), std::acos(cosine) / kPi);
      });
}

void trace(Oracle& ray, const CylinderShape& s) {
  const V p0(s.p0), axis = V(s.p1) - p0;
  const Number height = glm::length(axis);
  const V w = axis / height;
  const auto r = static_cast<Number>(s.radius);
  const V f = ray.o() - p0;
  const V fp = f - glm::dot(f, w) * w, dp = ray.d() - glm::dot(ray.d(), w) * w;
  Oracle::roots(glm::dot(dp, dp), glm::dot(fp, dp), glm::dot(fp, fp) - r * r, [&](Number t) {
    const V q = ray.at(t) - p0;
    const Number z = glm::dot(q, w);
    if (z < 0 || z > height) return;
    ray.report(t, q - z * w, 0, z / height, false, true);
  });
  for (const int end : {0, 1}) {
    const V center = end == 0 ? p0 : p0 + axis, n = end == 0 ? -w : w;
    const Number slope = glm::dot(n, ray.d());
    if (slope == 0) continue;
    const Number t = glm::dot(n, center - ray.o()) / slope;
    const Number rho = glm::length(ray.at(t) - center);
    if (rho <= r) ray.report(t, n, 0, rho / r, false, true);
  }
}

void trace(Oracle& ray, const DiscShape& s) {
  const V n = glm::normalize(V(s.normal));
  const Number slope = glm::dot(n, ray.d());
  if (slope == 0) return;
  const Number t = glm::dot(n, V(s.center) - ray.o()) / slope;
  const Number rho = glm::length(ray.at(t) - V(s.center)) / static_cast<Number>(s.radius);
  if (rho <= 1) ray.report(t, n, 0, rho, false, true);
}

void trace(Oracle& ray, const RectangleShape& s) {
  const V e1(s.edge_u), e2(s.edge_v);
  ray.plane(V(s.corner), e1, e2, [&](Number t, Number x, Number y) {
    if (x >= 0 && x <= 1 && y >= 0 && y <= 1) ray.report(t, glm::cross(e1, e2), x, y);
  });
}

void trace(Oracle& ray, const TriangleShape& s) {
  ray.triangle(V(s.a), V(s.b), V(s.c), glm::cross(V(s.b - s.a), V(s.c - s.a)), nullptr, true);
}

void trace(Oracle& ray, const PyramidShape& s) {
  const auto& v = s.vertices;
  const V middle(0.25 * (v[0] + v[1] + v[2] + v[3]));
  for (std::size_t i = 0; i < 4; ++i) {
    const V a(v[(i + 1) % 4]), b(v[(i + 2) % 4]), c(v[(i + 3) % 4]);
    V n = glm::cross(b - a, c - a);
    if (glm::dot(n, a - middle) < 0) n = -n;
    ray.triangle(a, b, c, n, nullptr, false);
  }
}

void trace(Oracle& ray, const BoxShape& s) {
  for (int axis = 0; axis < 3; ++axis) {
    // The other two, in the order of u and v.
    const int first = axis == 0 ? 2 : 0, second = axis == 1 ? 2 : 1;
    for (const bool high : {false, true}) {
      const auto level = static_cast<Number>(high ? s.max[axis] : s.min[axis]);
      if (ray.d()[axis] == 0) continue;
      const Number t = (level - ray.o()[axis]) / ray.d()[axis];
      const V q = ray.at(t);
      const auto share = [&](int k) {
        return (q[k] - static_cast<Number>(s.min[k])) / static_cast<Number>(s.max[k] - s.min[k]);
      };
      const Number u = share(first), v = share(second);
      V n(0);
      n[axis] = high ? 1 : -1;
      if (u >= 0 && u <= 1 && v >= 0 && v <= 1) ray.report(t, n, u, v);
    }
  }
}

void trace(Oracle& ray, const Mesh& mesh) {
  for (const auto& t : mesh.triangles) {
    const V a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    if (mesh.uvs.empty()) {
      ray.triangle(a, b, c, glm::cross(b - a, c - a), nullptr, true);
    } else {
      const glm::dvec2 uv[3] = {mesh.uvs[t[0]], mesh.uvs[t[1]], mesh.uvs[t[2]]};
      ray.triangle(a, b, c, glm::cross(b - a, c - a), uv, true);
    }
  }
}

}  // namespace

std::optional<OracleHit> oracle_hit(const Shape& shape, const Mesh& mesh, const glm::dvec3& o,
                                    const glm::dvec3& d, double time) {
  Oracle ray{V(o), V(d)};
  std::visit(
      [&](const auto& s) {
        using S = std::decay_t<decltype(s)>;
        if constexpr (std::is_same_v<S, SphereShape>) {
          trace(ray, s, time);
        } else if constexpr (std::is_same_v<S, MeshShape>) {
          trace(ray, mesh);
        } else {
          trace(ray, s);
        }
      },
      shape);
  return ray.best();
}

}  // namespace lightbench
