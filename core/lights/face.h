#pragma once
// Plane faces by which lights are seen: of ideal mirrors, and of boxes of clear glass (panes,
// core/lights/pane.h). A light seen in a mirror looks like a light behind it: sampling it from the
// mirrored point is sampling its image, and the density is that of the light itself from there.

#include "core/kernel/scene_view.h"
#include "core/kernel/vec.h"

LIGHTBENCH_KERNEL_BEGIN

/// One side of a face, which its unit normal n points out of. Dual coordinates (0, 0) .. (1, 1)
/// span a parallelogram, the half of it where they add up to 1 at most a triangle; of a disc they
/// are the unit disk's.
struct Face {
  Vec n, origin, dual_u, dual_v;
  Real outline;    ///< FaceOutline
  Real primitive;  ///< the solid or the plane that it belongs to
  Vec color;       ///< of a pane, of both refractions together
  Real offset;     ///< bound on the error of a point on it
  Real thickness;  ///< of the glass behind a pane
  Real ior;
  Real crowded;  ///< above 0 where something may be inside the glass
};

inline Face face_at(const auto& row) {
  return {row.vec(0),  row.vec(3), row.vec(6), row.vec(9), row[12], row[13],
          row.vec(14), row[17],    row[18],    row[19],    row[20]};
}

inline Vec mirrored(const Face& m, Vec p) { return madd(m.n, T(-2) * dot(m.n, p - m.origin), p); }
inline Vec mirrored_direction(const Face& m, Vec d) { return madd(m.n, T(-2) * dot(m.n, d), d); }

/// Dual coordinates of a point and its height over the mirror.
inline Vec place_before(const Face& m, Vec p) {
  const Vec q = p - m.origin;
  return {dot(m.dual_u, q), dot(m.dual_v, q), dot(m.n, q)};
}

inline Mask within_outline(const Face& m, Real a, Real b) {
  const Real disc(static_cast<T>(FaceOutline::Disc));
  const Real triangle(static_cast<T>(FaceOutline::Triangle));
  const Mask square = min(a, b) >= Real(0) && max(a, b) <= Real(1);
  return select(m.outline == disc, fma(a, a, b * b) <= Real(1),
                square && (m.outline != triangle || a + b <= Real(1)));
}

/// Roughly which share of a light's image is seen through the mirror from `place`; 0 where none is.
/// Numbers 11..13 of the candidate's row are the light's own place before the mirror, 14..16 its
/// extent around it, 17 the inverse of its height. The line from the point to the image's centre
/// crosses the mirror at (from height' + to height) / (height + height'), and its extent makes an
/// interval of that; both are multiplied by the sum of the heights here, to divide only once.
inline Real share_in_window(const Face& m, Vec place, const auto& candidate) {
  const Vec light = candidate.vec(11), extent = candidate.vec(14);
  const Real sum = place.z + light.z;
  // How far a change of the light's height along its extent moves the crossing.
  const Real slide = extent.z * min(place.z * candidate[17], Real(1));
  const Real lowest = select(m.outline == Real(static_cast<T>(FaceOutline::Disc)), -sum, Real(0));
  Real seen(1), whole(1);
  const auto cut = [&](Real from, Real to, Real radius) {
    const Real middle = fma(from, light.z, to * place.z);
    const Real half = fma(radius, place.z, abs(to - from) * slide);
    seen = seen * max(min(middle + half, sum) - max(middle - half, lowest), Real(0));
    whole = whole * max(half + half, sum * T(1e-6));
  };
  cut(place.x, light.x, extent.x);
  cut(place.y, light.y, extent.y);
  return select(place.z > Real(0) && seen > Real(0), seen / whole, Real(0));
}

/// Which face the points of `active` are on, by primitive and outward normal; kStraight for none.
inline Int face_of(const SceneView<T>& scene, Int primitive, Vec n, Mask active) {
  Int mirror(kStraight);
  Real nearest(T(0.5));
  for (std::uint32_t i = 0; i < scene.face_count; ++i) {
    const T* row = scene.faces + i * kFaceStride;
    const Real cosine = dot(Row{row}.vec(0), n);
    const Mask m =
        active && primitive == Int(static_cast<std::uint32_t>(row[13])) && cosine > nearest;
    nearest = select(m, cosine, nearest);
    mirror = select(m, Int(i), mirror);
  }
  return mirror;
}

/// Each active lane's own mirror.
inline Face faces_of(const SceneView<T>& scene, Int mirror, Mask active) {
  if (scene.face_columns != nullptr)
    return face_at(row_of_columns<kFaceStride>(scene.face_columns, mirror));
  return face_at(merged_rows<kFaceStride>(
      mirror, active, [&](std::uint32_t i) { return scene.faces + i * kFaceStride; }));
}

LIGHTBENCH_KERNEL_END
