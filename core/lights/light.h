#pragma once
// Light sampling: a light is chosen in proportion to its power by an alias table, then a direction
// to it by its shape. Every pdf here is the density of its sampler, in solid angle.

#include "core/accel/closest_hit.h"
#include "core/sampling/sobol.h"

LIGHTBENCH_KERNEL_BEGIN

struct LightChoice {
  Int light;
  Real pmf;
};

/// By 32 random bits; scene.light_count > 0.
inline LightChoice choose_light(const SceneView<T>& scene, Int random) {
  const Int i = scale_bits(random, scene.light_count);
  // The low half of the product is the position within the bin.
  const Mask keep =
      unit_from_bits(random * Int(scene.light_count)) < gather(scene.alias_threshold, i);
  const Int light = select(keep, i, gather(scene.alias_other, i));
  return {light, gather(scene.light_pmf, light)};
}

/// Which primitive (and triangle slot of a mesh) a light is.
struct LightPlace {
  Int primitive, slot;
};
inline LightPlace place_of(const SceneView<T>& scene, Int light) {
  return {gather(scene.light_primitive, light), gather(scene.light_slot, light)};
}

/// World-space triangle of a mesh light and its outward normal.
struct MeshLight {
  Triangle triangle;
  Vec n;
};
inline MeshLight mesh_light(const SceneView<T>& scene, const LaneRow& row, Int primitive, Int slot,
                            Mask m) {
  const MeshInstance instance = mesh_at(row);
  const Triangle t = fetch_triangle(scene, primitive, slot, m).vertices;
  return {to_world(instance, t),
          normalize(instance.to_local.transposed(cross(t.b - t.a, t.c - t.a)))};
}

/// Calls f(kind, mask) for each kind of light that some active lane wants.
template <class F>
void for_light_kinds(const SceneView<T>& scene, Int primitive, Mask active, F f) {
  const Int kind = gather(scene.kind, primitive);
  for (std::uint32_t kinds = scene.light_kinds; kinds != 0; kinds &= kinds - 1) {
    const auto k = static_cast<std::uint32_t>(__builtin_ctz(kinds));
    const Mask m = active && kind == Int(k);
    if (any(m)) f(static_cast<PrimitiveKind>(k), m);
  }
}

/// A direction from `from` to the light's shape; valid only where active.
inline LightSample sample_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time,
                                Vec2 u, Mask active) {
  LightSample s{Vec(Real(0)), Vec(Real(0)), Real(1), Real(1), Mask(false)};
  const Int primitive = select(active, place.primitive, Int(0U));
  const LaneRow row{scene.rows, gather(scene.row, primitive)};
  for_light_kinds(scene, primitive, active, [&](PrimitiveKind kind, Mask m) {
    LightSample r = s;
    switch (kind) {
      case PrimitiveKind::Sphere:
        r = sample_sphere(sphere_at(row, time), from, u);
        break;
      case PrimitiveKind::Ellipsoid:
        r = sample_ellipsoid(ellipsoid_at(row, time), from, u);
        break;
      case PrimitiveKind::Cylinder:
        r = sample_cylinder(cylinder_at(row), from, u);
        break;
      case PrimitiveKind::EllipticCylinder:
        r = sample_elliptic_cylinder(elliptic_cylinder_at(row), from, u);
        break;
      case PrimitiveKind::Disc:
        r = sample_disc(disc_at(row), from, u);
        break;
      case PrimitiveKind::Rectangle:
        r = sample_rectangle(rectangle_at(row), from, u);
        break;
      case PrimitiveKind::Triangle:
        r = sample_triangle(triangle_at(row), from, u);
        break;
      case PrimitiveKind::Pyramid:
        r = sample_pyramid(pyramid_at(row), from, u);
        break;
      case PrimitiveKind::Box:
        r = sample_box(box_at(row), from, u);
        break;
      case PrimitiveKind::Mesh: {
        const MeshLight light = mesh_light(scene, row, primitive, place.slot, m);
        r = sample_triangle(light.triangle, from, u);
        r.n = light.n;
        break;
      }
    }
    s.d = select(m, r.d, s.d);
    s.n = select(m, r.n, s.n);
    s.distance = select(m, r.distance, s.distance);
    s.pdf = select(m, r.pdf, s.pdf);
    s.valid = select(m, r.valid, s.valid);
  });
  s.valid = s.valid && active;
  return s;
}

/// Density with which sample_light() would choose the direction d, which meets that light at
/// distance t with outward normal n. 0 where !active.
inline Real pdf_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time, Vec d,
                      Real t, Vec n, Mask active) {
  Real pdf(0);
  const Int primitive = select(active, place.primitive, Int(0U));
  const LaneRow row{scene.rows, gather(scene.row, primitive)};
  for_light_kinds(scene, primitive, active, [&](PrimitiveKind kind, Mask m) {
    Real r(0);
    switch (kind) {
      case PrimitiveKind::Sphere:
        r = pdf_sphere(sphere_at(row, time), from, d, t, n);
        break;
      case PrimitiveKind::Ellipsoid:
        r = pdf_ellipsoid(ellipsoid_at(row, time), from, d, t, n);
        break;
      case PrimitiveKind::Cylinder:
        r = pdf_cylinder(cylinder_at(row), d, t, n);
        break;
      case PrimitiveKind::EllipticCylinder:
        r = pdf_elliptic_cylinder(elliptic_cylinder_at(row), d, t, n);
        break;
      case PrimitiveKind::Disc:
        r = pdf_disc(disc_at(row), from, d, t);
        break;
      case PrimitiveKind::Rectangle:
        r = pdf_rectangle(rectangle_at(row), from, d, t);
        break;
      case PrimitiveKind::Triangle:
        r = pdf_triangle(triangle_at(row), from, d, t);
        break;
      case PrimitiveKind::Pyramid:
        r = pdf_pyramid(pyramid_at(row), d, t, n);
        break;
      case PrimitiveKind::Box:
        r = pdf_box(box_at(row), d, t, n);
        break;
      case PrimitiveKind::Mesh: {
        const MeshLight light = mesh_light(scene, row, primitive, place.slot, m);
        r = pdf_triangle(light.triangle, from, d, t);
        break;
      }
    }
    pdf = select(m, r, pdf);
  });
  return pdf;
}

LIGHTBENCH_KERNEL_END
