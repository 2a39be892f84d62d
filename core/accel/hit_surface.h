#pragma once
// From the nearest hit to the surface there.

#include "core/accel/nearest_hit.h"
#include "core/shapes/box.h"
#include "core/shapes/cylinder.h"
#include "core/shapes/disc.h"
#include "core/shapes/mesh.h"
#include "core/shapes/pyramid.h"
#include "core/shapes/rectangle.h"
#include "core/shapes/sphere.h"
#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

/// Surface of the hits on primitive i; meaningful in the active lanes, all of which hit it. Never
/// inlined, like find_hits().
[[gnu::noinline]] inline Surface surface_of(const SceneView<T>& scene, std::uint32_t i,
                                            const Ray& ray, const NearestHit& hit, Mask active,
                                            Coordinates uv) {
  const Row row{scene.rows + scene.row[i]};
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Sphere:
      return surface_sphere(sphere_at(row, ray.time), ray, hit.t, scene.hit_quality, uv);
    case PrimitiveKind::Ellipsoid:
      return surface_ellipsoid(ellipsoid_at(row, ray.time), ray, hit.t, uv);
    case PrimitiveKind::Cylinder:
      return surface_cylinder(cylinder_at(row), ray, hit.t, scene.hit_quality, uv);
    case PrimitiveKind::EllipticCylinder:
      return surface_elliptic_cylinder(elliptic_cylinder_at(row), ray, hit.t, uv);
    case PrimitiveKind::Disc:
      return surface_disc(disc_at(row), ray, hit.t, uv);
    case PrimitiveKind::Rectangle:
      return surface_rectangle(rectangle_at(row), ray, hit.t, uv);
    case PrimitiveKind::Triangle:
      return surface_triangle(triangle_at(row), hit.b1, hit.b2, uv);
    case PrimitiveKind::Pyramid:
      return surface_pyramid(pyramid_at(row), ray, hit.t, uv);
    case PrimitiveKind::Box:
      return surface_box(box_at(row), ray, hit.t, uv);
    case PrimitiveKind::Mesh:
      break;
  }
  return surface_mesh(mesh_at(row), fetch_triangle(mesh_of(scene, i), hit.slot, active), hit.b1,
                      hit.b2, uv);
}

/// All but the tangent, which paths have no use for.
inline void merge(Mask m, const Surface& from, Surface& into) {
  into.p = select(m, from.p, into.p);
  into.ng = select(m, from.ng, into.ng);
  into.ns = select(m, from.ns, into.ns);
  into.u = select(m, from.u, into.u);
  into.v = select(m, from.v, into.v);
}

LIGHTBENCH_KERNEL_END
