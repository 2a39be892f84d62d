#pragma once
// Box with any orientation: three slabs in its own frame.

#include "core/sampling/warp.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// Unit, perpendicular axes and half extents along them.
struct Box {
  static constexpr unsigned kRow = 15;
  Vec center, axis[3], half;
};

inline Box box_at(const Row& row) {
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

inline Real area_of_box(const Box& s) {
  return T(8) * (s.half.x * s.half.y + s.half.y * s.half.z + s.half.z * s.half.x);
}

/// Uniform over the surface.
inline LightSample sample_box(const Box& s, Vec from, Vec2 u) {
  const Real xy = s.half.x * s.half.y, yz = s.half.y * s.half.z, zx = s.half.z * s.half.x;
  const Real total = xy + yz + zx;
  const Real w = u.x * total;
  const Mask on_x = w < yz, on_y = !on_x && w < yz + zx, on_z = !on_x && !on_y;
  // Position within the chosen pair of faces, then which of the two.
  const Real share = select(on_x, w / yz, select(on_y, (w - yz) / zx, (w - yz - zx) / xy)) * T(2);
  const Mask positive = share >= Real(1);
  const Real a =
      clamp(select(positive, share - Real(1), share) * T(2) - Real(1), Real(-1), Real(1));
  const Real b = u.y * T(2) - Real(1);
  const Real side = select(positive, Real(1), Real(-1));
  const Vec local{s.half.x * select(on_x, side, a),
                  s.half.y * select(on_y, side, select(on_x, a, b)),
                  s.half.z * select(on_z, side, b)};
  const Vec n = select(on_x, s.axis[0], select(on_y, s.axis[1], s.axis[2])) * side;
  return toward_point(from, s.center + from_box(s, local), n, Real(1) / area_of_box(s));
}

inline Real pdf_box(const Box& s, Vec d, Real t, Vec n) {
  return solid_angle_pdf(Real(1) / area_of_box(s), t * t, abs(dot(n, d)));
}

LIGHTBENCH_KERNEL_END
