#pragma once
// From the nearest hit to the surface there.

#include "core/accel/nearest_hit.h"
#include "core/shapes/any_shape.h"

LIGHTBENCH_KERNEL_BEGIN

inline void merge(Mask m, const Surface& from, Surface& into) {
  into.p = select(m, from.p, into.p);
  into.ng = select(m, from.ng, into.ng);
  into.ns = select(m, from.ns, into.ns);
  into.u = select(m, from.u, into.u);
  into.v = select(m, from.v, into.v);
  into.tangent = select(m, from.tangent, into.tangent);
}

/// Surface of the hits on shapes of one kind.
template <PrimitiveKind kKind>
[[gnu::noinline]] inline Surface surface_of_kind(const SceneView<T>& scene, const Ray& ray,
                                                 const NearestHit& hit, Mask active,
                                                 Coordinates uv) {
  const auto shape = shape_at<kKind>(rows_of<kKind>(scene, hit.primitive, active), ray.time);
  if constexpr (kKind == PrimitiveKind::Sphere)
    return surface_sphere(shape, ray, hit.t, hit_quality(scene), uv);
  if constexpr (kKind == PrimitiveKind::Ellipsoid) return surface_ellipsoid(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Cylinder)
    return surface_cylinder(shape, ray, hit.t, hit_quality(scene), uv);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder)
    return surface_elliptic_cylinder(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Disc) return surface_disc(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Rectangle) return surface_rectangle(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Triangle)
    return surface_triangle(shape, hit.b1, hit.b2, uv);
  if constexpr (kKind == PrimitiveKind::Pyramid) return surface_pyramid(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Box) return surface_box(shape, ray, hit.t, uv);
  if constexpr (kKind == PrimitiveKind::Mesh) {
    return surface_mesh(shape, fetch_triangles(scene, hit.primitive, hit.slot, active), hit.b1,
                        hit.b2, uv);
  }
}

/// Surface of the hits; meaningful in the active lanes, all of which hit something. `textured` are
/// the lanes whose uv is wanted.
inline Surface surface_of(const SceneView<T>& scene, const Ray& ray, const NearestHit& hit,
                          Mask active, Mask textured) {
  Surface surface;
  surface.p = surface.ng = surface.ns = Vec(Real(0));
  for_each_kind(scene, hit.primitive, active, [&]<PrimitiveKind kKind>(Mask m) {
    const Coordinates uv = any(m && textured) ? Coordinates::Wanted : Coordinates::None;
    merge(m, surface_of_kind<kKind>(scene, ray, hit, m, uv), surface);
  });
  return surface;
}

LIGHTBENCH_KERNEL_END
