#pragma once
// Triangle: the watertight test of Woop, Benthin, Wald (JCGT 2:1, 2013), shared by single triangles
// and meshes. Antisymmetry of its edge functions needs -ffp-contract=off.

#include "core/sampling/spherical_triangle.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

struct Triangle {
  static constexpr unsigned kRow = 10;
  Vec a, b, c;
  Real facing = Real(1);  ///< -1 if a mirroring transform turned the winding; the front stays
};

inline Triangle triangle_at(const auto& row) {
  return {row.vec(0), row.vec(3), row.vec(6), row[9]};
}

/// Hit with barycentrics of the vertices b and c; a mask as wide as the numbers.
template <class R>
struct ShearedHit {
  R t, b1, b2;
  decltype(R() < R()) hit;
};
using TriangleHit = ShearedHit<Real>;

/// A vertex relative to the ray's origin, axes permuted so that z is the direction's largest.
template <class R>
struct ShearedVertex {
  R x, y, z;
};

/// (sx, sy, sz) = (dx, dy, 1) / dz. Edges are inclusive: a shared edge belongs to both triangles.
template <class R>
ShearedHit<R> hit_sheared(const ShearedVertex<R>& a, const ShearedVertex<R>& b,
                          const ShearedVertex<R>& c, const R& sx, const R& sy, const R& sz) {
  const R ax = a.x - sx * a.z, ay = a.y - sy * a.z;
  const R bx = b.x - sx * b.z, by = b.y - sy * b.z;
  const R cx = c.x - sx * c.z, cy = c.y - sy * c.z;
  const R u = cx * by - cy * bx;
  const R v = ax * cy - ay * cx;
  const R w = bx * ay - by * ax;
  const auto all_positive = u >= R(0) && v >= R(0) && w >= R(0);
  const auto all_negative = u <= R(0) && v <= R(0) && w <= R(0);
  const R det = u + v + w;
  auto hit = (all_positive || all_negative) && det != R(0);
  // Rounding keeps the order of the two products, so an edge function can lose its sign but not
  // change it: a triangle that holds the ray is never lost, and one that does not is found only
  // where a function is 0. Seen edge-on two of them can be, however far beside the ray it lies.
  const auto doubtful = hit && (u == R(0) || v == R(0) || w == R(0));
  if (any(doubtful)) {
    const auto around = [](const R& p, const R& q, const R& r) {
      return min(p, min(q, r)) <= R(0) && max(p, max(q, r)) >= R(0);
    };
    hit = hit && (!doubtful || (around(ax, bx, cx) && around(ay, by, cy)));
  }
  const R inverse = R(1) / select(hit, det, R(1));
  const R t = (u * (sz * a.z) + v * (sz * b.z) + w * (sz * c.z)) * inverse;
  return {t, v * inverse, w * inverse, hit};
}

/// The permutation and shear of a ray.
struct Shear {
  Mask z_is_x, z_is_y;
  Real sx, sy, sz;
  explicit Shear(Vec d) {
    const Real x = abs(d.x), y = abs(d.y), z = abs(d.z);
    z_is_x = x >= y && x >= z;
    z_is_y = !z_is_x && y >= z;
    const Vec k = permute(d);
    sz = Real(1) / k.z;
    sx = k.x * sz;
    sy = k.y * sz;
  }
  [[nodiscard]] Vec permute(Vec v) const {
    return {select(z_is_x, v.y, select(z_is_y, v.z, v.x)),
            select(z_is_x, v.z, select(z_is_y, v.x, v.y)),
            select(z_is_x, v.x, select(z_is_y, v.y, v.z))};
  }
};

inline TriangleHit hit_triangle(const Triangle& s, const Ray& ray) {
  const Shear shear(ray.d);
  const auto vertex = [&](Vec v) {
    const Vec p = shear.permute(v - ray.o);
    return ShearedVertex<Real>{p.x, p.y, p.z};
  };
  return hit_sheared(vertex(s.a), vertex(s.b), vertex(s.c), shear.sx, shear.sy, shear.sz);
}

/// Of the barycentrics, in one step. Larger ones are rounding themselves: the ray all but lies in
/// the plane, and the hit stays what the edge functions made of it.
inline constexpr T kLargestRefinement = T(0.25);

/// One step of iterative refinement of an accepted hit (distance and barycentrics; the verdict
/// stays). In a sliver the edge functions cancel: their point is in the plane, but slides along the
/// long sides by many roundings. What remains between it and the ray's own point is small and known
/// to the last bits, so solving for it (Möller, Trumbore, JGT 2:1, 1997) leaves the error of one
/// rounding.
inline TriangleHit refine_triangle(const Triangle& s, Vec o, Vec d, TriangleHit h) {
  const Vec e1 = s.b - s.a, e2 = s.c - s.a;
  const Vec rest = madd(d, h.t, o - s.a) - madd(e1, h.b1, e2 * h.b2);
  const Vec p = cross(d, e2), q = cross(rest, e1);
  const Real det = dot(e1, p);
  const Real inverse = Real(1) / det;
  const Real step1 = dot(rest, p) * inverse, step2 = dot(d, q) * inverse;
  const Real t = fma(dot(e2, q), inverse, h.t);
  const Mask good =
      abs(step1) < Real(kLargestRefinement) && abs(step2) < Real(kLargestRefinement) && t > Real(0);
  // Rounding can carry a hit at the border across it.
  const Real b1 = clamp(h.b1 + step1, Real(0), Real(1));
  const Real b2 = clamp(h.b2 + step2, Real(0), Real(1) - b1);
  return {select(good, t, h.t), select(good, b1, h.b1), select(good, b2, h.b2), h.hit};
}

/// uv = barycentrics (b1, b2).
inline Surface surface_triangle(const Triangle& s, Real b1, Real b2, Coordinates uv) {
  Surface r;
  const Vec e1 = s.b - s.a, e2 = s.c - s.a;
  r.p = madd(e1, b1, madd(e2, b2, s.a));
  r.ng = normalize(cross(e1, e2)) * s.facing;
  r.ns = r.ng;
  r.u = b1;
  r.v = b2;
  if (uv == Coordinates::Wanted) r.tangent = normalize(e1);
  return r;
}

/// pdf of its samples: 1 / solid angle.
inline Real pdf_triangle(const Triangle& s, Vec from) {
  const Vec a = s.a - from, b = s.b - from, c = s.c - from;
  const Vec e1 = s.b - s.a, e2 = s.c - s.a;
  // What rounding takes from the edges tilts a sliver.
  const Real determinant =
      triple_product(a, difference_error(s.a, from, a), e1, difference_error(s.b, s.a, e1), e2,
                     difference_error(s.c, s.a, e2));
  return T(0.5) / half_solid_angle(a, b, c, length(a), length(b), length(c), abs(determinant));
}

/// Uniform over the solid angle.
inline LightSample sample_triangle(const Triangle& s, Vec from, Vec2 u) {
  const Vec e1 = s.b - s.a, e2 = s.c - s.a, a = s.a - from;
  const Real pdf = pdf_triangle(s, from);
  const Vec d = sample_spherical_fan(a, s.b - from, e1, e2, u.x * (T(0.5) / pdf), u.y);
  return toward_plane(d, a, normalize(cross(e1, e2)) * s.facing, pdf);
}

LIGHTBENCH_KERNEL_END
