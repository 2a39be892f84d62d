#pragma once
// Box with any orientation: three slabs in its own frame.

#include "core/sampling/spherical_parallelogram.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// Unit, perpendicular axes and half extents along them.
struct Box {
  static constexpr unsigned kRow = 15;
  Vec center, axis[3], half;
};

inline Box box_at(const auto& row) {
  return {row.vec(0), {row.vec(3), row.vec(6), row.vec(9)}, row.vec(12)};
}

inline Vec to_box(const Box& s, Vec v) {
  return {dot(s.axis[0], v), dot(s.axis[1], v), dot(s.axis[2], v)};
}
inline Vec from_box(const Box& s, Vec v) {
  return madd(s.axis[0], v.x, madd(s.axis[1], v.y, s.axis[2] * v.z));
}

struct BoxInterval {
  Interval span;
  Int near_axis, far_axis;
};

inline BoxInterval hit_box_faces(const Box& s, const Ray& ray) {
  const Vec f = to_box(s, ray.o - s.center), d = to_box(s, ray.d);
  BoxInterval r;
  r.span.near = Real(-kInfinity);
  r.span.far = Real(kInfinity);
  r.near_axis = Int(0U);
  r.far_axis = Int(0U);
  const Real fs[3] = {f.x, f.y, f.z}, ds[3] = {d.x, d.y, d.z},
             hs[3] = {s.half.x, s.half.y, s.half.z};
  for (unsigned i = 0; i < 3; ++i) {
    // A ray along the slab has infinite distances of opposite sign inside it, of equal sign
    // outside.
    const Real inverse = Real(1) / ds[i];
    const Real t0 = (-hs[i] - fs[i]) * inverse, t1 = (hs[i] - fs[i]) * inverse;
    const Real near = min(t0, t1), far = max(t0, t1);
    const Mask enters = near > r.span.near, leaves = far < r.span.far;
    r.span.near = select(enters, near, r.span.near);
    r.near_axis = select(enters, Int(i), r.near_axis);
    r.span.far = select(leaves, far, r.span.far);
    r.far_axis = select(leaves, Int(i), r.far_axis);
  }
  r.span.hit = r.span.near < r.span.far;
  return r;
}

inline Interval hit_box(const Box& s, const Ray& ray) { return hit_box_faces(s, ray).span; }

/// uv: the two other coordinates of the face, each 0..1 from min to max.
inline Surface surface_box(const Box& s, const Ray& ray, Real t, Coordinates uv) {
  const BoxInterval i = hit_box_faces(s, ray);
  const Int axis = select(at_exit(i.span, t), i.far_axis, i.near_axis);
  const Vec q = to_box(s, madd(ray.d, t, ray.o - s.center));
  const Mask on_x = axis == Int(0U), on_y = axis == Int(1U), on_z = axis == Int(2U);
  // The face's own coordinate is exact, the others stay within the face.
  const Vec local{select(on_x, copysign(s.half.x, q.x), clamp(q.x, -s.half.x, s.half.x)),
                  select(on_y, copysign(s.half.y, q.y), clamp(q.y, -s.half.y, s.half.y)),
                  select(on_z, copysign(s.half.z, q.z), clamp(q.z, -s.half.z, s.half.z))};
  Surface r;
  r.p = s.center + from_box(s, local);
  const Vec n =
      select(on_x, s.axis[0] * copysign(Real(1), q.x),
             select(on_y, s.axis[1] * copysign(Real(1), q.y), s.axis[2] * copysign(Real(1), q.z)));
  r.ng = n;
  r.ns = n;
  if (uv == Coordinates::None) return r;
  const Vec share{(local.x / s.half.x + Real(1)) * T(0.5), (local.y / s.half.y + Real(1)) * T(0.5),
                  (local.z / s.half.z + Real(1)) * T(0.5)};
  r.u = select(on_x, share.z, share.x);
  r.v = select(on_y, share.z, share.y);
  r.tangent = select(on_x, s.axis[2], s.axis[0]);
  return r;
}

/// The faces that a point sees, one of each pair at most, in the box's frame; half the solid angle
/// of the others is 0.
struct BoxView {
  SphericalParallelogram face[3];
  Vec side;      ///< of the point: the sign of the outward normal of each face
  Real total;    ///< half the solid angle of the box
  Mask outside;  ///< of at least one face, beyond rounding
};

inline BoxView view_box(const Box& s, Vec from) {
  // Heights over the faces without what rounding takes: of a flat box seen along its large faces
  // they would be wrong by more than its thickness times the precision.
  const Vec w = from - s.center, w_lost = difference_error(from, s.center, w), exact(Real(0));
  const ExactDot fx = exact_dot(w, w_lost, s.axis[0], exact);
  const ExactDot fy = exact_dot(w, w_lost, s.axis[1], exact);
  const ExactDot fz = exact_dot(w, w_lost, s.axis[2], exact);
  const Vec f{fx.value, fy.value, fz.value}, h = s.half;
  BoxView r;
  r.side = {copysign(Real(1), f.x), copysign(Real(1), f.y), copysign(Real(1), f.z)};
  const Vec low = -h - f, face = h * r.side, rounded = face - f;
  const Vec near = rounded + (difference_error(face, f, rounded) - Vec{fx.lost, fy.lost, fz.lost});
  const Vec x{h.x * Real(2), Real(0), Real(0)}, y{Real(0), h.y * Real(2), Real(0)},
      z{Real(0), Real(0), h.z * Real(2)};
  r.face[0] = spherical_parallelogram({near.x, low.y, low.z}, exact, y, z);
  r.face[1] = spherical_parallelogram({low.x, near.y, low.z}, exact, z, x);
  r.face[2] = spherical_parallelogram({low.x, low.y, near.z}, exact, x, y);
  const Vec height = -(near * r.side);
  const Mask seen[3] = {height.x > Real(0), height.y > Real(0), height.z > Real(0)};
  r.total = Real(0);
  for (unsigned i = 0; i < 3; ++i) {
    r.face[i].half = select(seen[i], r.face[i].half, Real(0));
    r.total += r.face[i].half;
  }
  const Real margin = Real(kSurfaceMargin) * (h.x + h.y + h.z);
  r.outside = max_component(height) > margin;
  return r;
}

/// Uniform over the solid angle of the faces that look at the point; all around from inside.
inline LightSample sample_box(const Box& s, Vec from, Vec2 u) {
  const BoxView view = view_box(s, from);
  // The face whose share of the solid angle u.x falls into, and how far into it.
  SphericalParallelogram face = view.face[0];
  Vec n = s.axis[0] * view.side.x;
  Real swept = u.x * view.total, behind(0);
  const Real sides[3] = {view.side.x, view.side.y, view.side.z};
  for (unsigned i = 1; i < 3; ++i) {
    behind += view.face[i - 1].half;
    const Mask m = u.x * view.total >= behind && view.face[i].half > Real(0);
    face = select(m, view.face[i], face);
    n = select(m, s.axis[i] * sides[i], n);
    swept = select(m, u.x * view.total - behind, swept);
  }
  const Vec d = from_box(s, sample_spherical_parallelogram(face, swept, u.y));
  LightSample r = toward_plane(d, from_box(s, face.corner), n, T(0.5) / view.total);
  if (any(!view.outside)) {
    const Ray ray = probe_ray(from, square_to_sphere(u));
    const Interval span = hit_box(s, ray);
    const Vec inner = surface_box(s, ray, first_end(span), Coordinates::None).ng;
    r = select(view.outside, r, toward_solid(ray.d, span, inner, Real(kPdfSphere)));
  }
  return r;
}

inline Real pdf_box(const Box& s, Vec from) {
  const BoxView view = view_box(s, from);
  return select(view.outside, T(0.5) / view.total, Real(kPdfSphere));
}

LIGHTBENCH_KERNEL_END
