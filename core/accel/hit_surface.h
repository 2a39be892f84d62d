#pragma once
// From the nearest hit to the surface there.

#include "core/accel/nearest_hit.h"
#include "core/shapes/any_shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// Surface of one shape's hits.
template <PrimitiveKind kKind>
inline Surface surface_at(const SceneView<T>& scene, const auto& shape, const Ray& ray,
                          const NearestHit& hit, Mask active, Coordinates uv) {
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

/// Puts the surface of the hits on shapes of one kind into those lanes of `surface`. Out of line,
/// so what it leaves alone need not pass through memory: only meshes have shading normals of their
/// own, and only textures and queries want coordinates.
template <PrimitiveKind kKind>
[[gnu::noinline]] inline void find_surface_of_kind(const SceneView<T>& scene, const Ray& ray,
                                                   const NearestHit& hit, Mask lanes,
                                                   Coordinates uv, Surface& surface) {
  const auto shape = shape_at<kKind>(rows_of<kKind>(scene, hit.primitive, lanes), ray.time);
  const Surface s = surface_at<kKind>(scene, shape, ray, hit, lanes, uv);
  surface.p = select(lanes, s.p, surface.p);
  surface.ng = select(lanes, s.ng, surface.ng);
  if constexpr (kKind == PrimitiveKind::Mesh) surface.ns = select(lanes, s.ns, surface.ns);
  if (uv == Coordinates::None) return;
  surface.u = select(lanes, s.u, surface.u);
  surface.v = select(lanes, s.v, surface.v);
  surface.tangent = select(lanes, s.tangent, surface.tangent);
}

/// Surface of the hits; meaningful in the active lanes, all of which hit something. `textured` are
/// the lanes whose uv is wanted.
inline void find_surfaces(const SceneView<T>& scene, const Ray& ray, const NearestHit& hit,
                          Mask active, Mask textured, Surface& surface) {
  surface.p = surface.ng = surface.ns = Vec(Real(0));
  Mask smooth(false);
  for_each_kind(scene, hit.primitive, active, [&]<PrimitiveKind kKind>(Mask m) {
    const Coordinates uv = any(m && textured) ? Coordinates::Wanted : Coordinates::None;
    if constexpr (kKind == PrimitiveKind::Mesh) smooth = m;
    find_surface_of_kind<kKind>(scene, ray, hit, m, uv, surface);
  });
  surface.ns = select(smooth, surface.ns, surface.ng);
}

/// The same by value, which costs a copy.
inline Surface surface_of(const SceneView<T>& scene, const Ray& ray, const NearestHit& hit,
                          Mask active, Mask textured) {
  Surface surface;
  find_surfaces(scene, ray, hit, active, textured, surface);
  return surface;
}

LIGHTBENCH_KERNEL_END
