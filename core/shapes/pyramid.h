#pragma once
// Triangular pyramid (solid tetrahedron): four half-spaces relative to its first vertex, clipped.

#include "core/sampling/warp.h"
#include "core/shapes/shape.h"
#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

/// Vertices v0, v0 + edge[0..2]. Face i lies opposite vertex i, outward unit normal n[i], at n . (p
/// - v0) = h[i]; h is 0 but for face 0. Vertices are ordered (by compile) so that the normals of
/// the faces in `face_triangle` point outward.
struct Pyramid {
  static constexpr unsigned kRow = 25;
  Vec v0, edge[3], n[4];
  Real h0;
};

inline Pyramid pyramid_at(const auto& row) {
  Pyramid s;
  s.v0 = row.vec(0);
  for (unsigned i = 0; i < 3; ++i) s.edge[i] = row.vec(3 + 3 * i);
  for (unsigned i = 0; i < 4; ++i) s.n[i] = row.vec(12 + 3 * i);
  s.h0 = row[24];
  return s;
}

struct PyramidInterval {
  Interval span;
  Int near_face, far_face;
};

inline PyramidInterval hit_pyramid_faces(const Pyramid& s, const Ray& ray) {
  PyramidInterval r;
  r.span.near = Real(-kInfinity);
  r.span.far = Real(kInfinity);
  r.near_face = Int(0U);
  r.far_face = Int(0U);
  Mask outside_parallel = false;
  const Vec f = ray.o - s.v0;
  for (unsigned i = 0; i < 4; ++i) {
    const Real height = (i == 0 ? s.h0 : Real(0)) - dot(s.n[i], f);
    const Real slope = dot(s.n[i], ray.d);
    const Real t = height / slope;
    const Mask enters = slope < Real(0) && t > r.span.near;
    const Mask leaves = slope > Real(0) && t < r.span.far;
    r.span.near = select(enters, t, r.span.near);
    r.near_face = select(enters, Int(i), r.near_face);
    r.span.far = select(leaves, t, r.span.far);
    r.far_face = select(leaves, Int(i), r.far_face);
    outside_parallel = outside_parallel || (slope == Real(0) && height < Real(0));
  }
  r.span.hit = r.span.near < r.span.far && !outside_parallel;
  return r;
}

inline Interval hit_pyramid(const Pyramid& s, const Ray& ray) {
  return hit_pyramid_faces(s, ray).span;
}

/// The triangle of face i, counter-clockwise seen from outside.
inline Triangle face_triangle(const Pyramid& s, unsigned i) {
  const Vec a = s.v0 + s.edge[0], b = s.v0 + s.edge[1], c = s.v0 + s.edge[2];
  switch (i) {
    case 0:
      return {a, b, c};
    case 1:
      return {s.v0, c, b};
    case 2:
      return {s.v0, a, c};
    default:
      return {s.v0, b, a};
  }
}

inline Vec face_normal(const Pyramid& s, Int face) {
  return select(face == Int(0U), s.n[0],
                select(face == Int(1U), s.n[1], select(face == Int(2U), s.n[2], s.n[3])));
}

/// Each lane's own face.
inline Triangle face_triangles(const Pyramid& s, Int face) {
  Triangle r = face_triangle(s, 0U);
  for (unsigned i = 1; i < 4; ++i) {
    const Mask m = face == Int(i);
    const Triangle k = face_triangle(s, i);
    r = {select(m, k.a, r.a), select(m, k.b, r.b), select(m, k.c, r.c)};
  }
  return r;
}

/// uv: barycentrics of the face.
inline Surface surface_pyramid(const Pyramid& s, const Ray& ray, Real t, Coordinates uv) {
  const PyramidInterval i = hit_pyramid_faces(s, ray);
  const Int face = select(at_exit(i.span, t), i.far_face, i.near_face);
  const Triangle tri = face_triangles(s, face);
  const Vec e1 = tri.b - tri.a, e2 = tri.c - tri.a;
  const Vec nn = cross(e1, e2);
  const Vec q = madd(ray.d, t, ray.o - tri.a);
  const Real inverse = Real(1) / length_squared(nn);
  Surface r;
  // Far rays that graze the face land beyond its edges by the rounding of t.
  r.u = clamp(dot(cross(q, e2), nn) * inverse, Real(0), Real(1));
  r.v = clamp(dot(cross(e1, q), nn) * inverse, Real(0), Real(1) - r.u);
  r.p = madd(e1, r.u, madd(e2, r.v, tri.a));
  r.ng = face_normal(s, face);
  r.ns = r.ng;
  if (uv == Coordinates::Wanted) r.tangent = normalize(e1);
  return r;
}

/// A vertex of face i relative to a point, its edges to the two others (counter-clockwise seen from
/// outside), and what rounding takes from the three.
struct FaceCorner {
  Vec p, pq, pr, p_lost, pq_lost, pr_lost;
};

inline FaceCorner select(Mask m, const FaceCorner& a, const FaceCorner& b) {
  return {select(m, a.p, b.p),
          select(m, a.pq, b.pq),
          select(m, a.pr, b.pr),
          select(m, a.p_lost, b.p_lost),
          select(m, a.pq_lost, b.pq_lost),
          select(m, a.pr_lost, b.pr_lost)};
}

/// The faces that a point sees: half the solid angle of each, 0 for those that look away.
struct PyramidView {
  FaceCorner face[4];
  Real half[4];
  Real total;    ///< half the solid angle of the pyramid
  Mask outside;  ///< of at least one face, beyond rounding
};

inline PyramidView view_pyramid(const Pyramid& s, Vec from) {
  const Vec* const e = s.edge;
  const Vec exact(Real(0)), f = s.v0 - from, f_lost = difference_error(s.v0, from, f);
  const Vec p = f + e[0], u = e[1] - e[0], v = e[2] - e[0];
  PyramidView r;
  // Heights over the faces without what rounding takes: of a flat pyramid seen along its large
  // faces they would be wrong by more than its thickness times the precision.
  r.face[0] = {p,
               u,
               v,
               f_lost + difference_error(f, -e[0], p),
               difference_error(e[1], e[0], u),
               difference_error(e[2], e[0], v)};
  r.face[1] = {f, e[2], e[1], f_lost, exact, exact};
  r.face[2] = {f, e[0], e[2], f_lost, exact, exact};
  r.face[3] = {f, e[1], e[0], f_lost, exact, exact};
  const Real size = sqrt(length_squared(e[0]) + length_squared(e[1]) + length_squared(e[2]));
  const Real margin = Real(kSurfaceMargin) * size;
  r.total = Real(0);
  r.outside = false;
  for (unsigned i = 0; i < 4; ++i) {
    const FaceCorner& c = r.face[i];
    const Real height = -triple_product(c.p, c.p_lost, c.pq, c.pq_lost, c.pr, c.pr_lost);
    const Vec q = c.p + c.pq, k = c.p + c.pr;
    const Real lp = length(c.p), lq = length(q), lk = length(k);
    Real divisor = solid_angle_divisor(c.p, q, k, lp, lq, lk);
    // From nearby its terms may cancel, and the determinant be as small.
    const Mask cancels = height > Real(0) && max(height, abs(divisor)) < T(0.25) * (lp * lq * lk);
    if (any(cancels)) {
      const Vec q_lost = c.p_lost + c.pq_lost + difference_error(c.p, -c.pq, q);
      const Vec k_lost = c.p_lost + c.pr_lost + difference_error(c.p, -c.pr, k);
      divisor =
          select(cancels, exact_solid_angle_divisor(c.p, c.p_lost, q, q_lost, k, k_lost), divisor);
    }
    const Real half = atan2(height, divisor);
    r.half[i] = select(height > Real(0), half, Real(0));
    r.total += r.half[i];
    r.outside = r.outside || -dot(s.n[i], c.p) > margin;
  }
  return r;
}

/// Uniform over the solid angle of the faces that look at the point; all around from inside.
inline LightSample sample_pyramid(const Pyramid& s, Vec from, Vec2 u) {
  const PyramidView view = view_pyramid(s, from);
  // The face whose share of the solid angle u.x falls into, and how far into it.
  Int face(0U);
  FaceCorner corner = view.face[0];
  Real swept = u.x * view.total, behind(0);
  for (unsigned i = 1; i < 4; ++i) {
    behind += view.half[i - 1];
    const Mask m = u.x * view.total >= behind && view.half[i] > Real(0);
    face = select(m, Int(i), face);
    corner = select(m, view.face[i], corner);
    swept = select(m, u.x * view.total - behind, swept);
  }
  const Vec d =
      sample_spherical_fan(corner.p, corner.p + corner.pq, corner.pq, corner.pr, swept, u.y);
  LightSample r = toward_plane(d, corner.p, face_normal(s, face), T(0.5) / view.total);
  if (any(!view.outside)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const PyramidInterval i = hit_pyramid_faces(s, ray);
    const Vec n = face_normal(s, select(i.span.near > Real(0), i.near_face, i.far_face));
    r = select(view.outside, r, toward_solid(ray.d, i.span, n, Real(kPdfSphere)));
  }
  return r;
}

inline Real pdf_pyramid(const Pyramid& s, Vec from) {
  const PyramidView view = view_pyramid(s, from);
  return select(view.outside, T(0.5) / view.total, Real(kPdfSphere));
}

LIGHTBENCH_KERNEL_END
