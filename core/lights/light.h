#pragma once
// Light sampling: a light is chosen in proportion to its power by an alias table, then a direction
// to it by its shape. Every pdf here is the density of its sampler, in solid angle.

#include "core/accel/hit_surface.h"
#include "core/accel/primitive_hit.h"
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

/// World-space triangles of mesh light i and their outward normals.
struct MeshLight {
  Triangle triangle;
  Vec n;
};
inline MeshLight mesh_light(const SceneView<T>& scene, std::uint32_t i, Int slot, Mask active) {
  const MeshInstance instance = mesh_at({scene.rows + scene.row[i]});
  const Triangle t = fetch_triangle(mesh_of(scene, i), slot, active).vertices;
  return {to_world(instance, t),
          normalize(instance.to_local.transposed(cross(t.b - t.a, t.c - t.a)))};
}

/// A direction from `from` to the solid of one row. Out of line, as its density is: in line, the
/// rarer shapes cost the headline scene time that it does not spend in them.
template <PrimitiveKind kKind>
[[gnu::noinline]] inline LightSample sample_solid(const Row& row, Vec from, Real time, Vec2 u) {
  if constexpr (kKind == PrimitiveKind::Sphere) return sample_sphere(sphere_at(row, time), from, u);
  if constexpr (kKind == PrimitiveKind::Ellipsoid) {
    return sample_ellipsoid(ellipsoid_at(row, time), axes_of_ellipsoid(row), from, u);
  }
  if constexpr (kKind == PrimitiveKind::Cylinder) return sample_cylinder(cylinder_at(row), from, u);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder) {
    return sample_elliptic_cylinder(elliptic_cylinder_at(row), from, u);
  }
  if constexpr (kKind == PrimitiveKind::Pyramid) return sample_pyramid(pyramid_at(row), from, u);
  if constexpr (kKind == PrimitiveKind::Box) return sample_box(box_at(row), from, u);
}
template <PrimitiveKind kKind>
[[gnu::noinline]] inline Real pdf_solid(const Row& row, Vec from, Real time, Vec d, Vec n) {
  if constexpr (kKind == PrimitiveKind::Sphere) return pdf_sphere(sphere_at(row, time), from);
  if constexpr (kKind == PrimitiveKind::Ellipsoid) {
    return pdf_ellipsoid(ellipsoid_at(row, time), axes_of_ellipsoid(row), from, d);
  }
  if constexpr (kKind == PrimitiveKind::Cylinder) return pdf_cylinder(cylinder_at(row), from, d, n);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder) {
    return pdf_elliptic_cylinder(elliptic_cylinder_at(row), from, d, n);
  }
  if constexpr (kKind == PrimitiveKind::Pyramid) return pdf_pyramid(pyramid_at(row), from);
  if constexpr (kKind == PrimitiveKind::Box) return pdf_box(box_at(row), from);
}

/// A direction from `from` to the shape of light i.
inline LightSample sample_light_of(const SceneView<T>& scene, std::uint32_t i, Int slot, Vec from,
                                   Real time, Vec2 u, Mask active) {
  const Row row{scene.rows + scene.row[i]};
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Disc:
      return sample_disc(disc_at(row), from, u);
    case PrimitiveKind::Rectangle:
      return sample_rectangle(rectangle_at(row), from, u);
    case PrimitiveKind::Triangle:
      return sample_triangle(triangle_at(row), from, u);
    case PrimitiveKind::Mesh: {
      const MeshLight light = mesh_light(scene, i, slot, active);
      LightSample s = sample_triangle(light.triangle, from, u);
      s.n = light.n;
      return s;
    }
    default:
      return with_kind(scene, i, [&]<PrimitiveKind kKind>() -> LightSample {
        if constexpr (is_planar(kKind)) {
          return {Vec(Real(0)), Vec(Real(0)), Real(0), Real(0), Mask(false)};
        } else {
          return sample_solid<kKind>(row, from, time, u);
        }
      });
  }
}

/// Density with which sample_light_of() would choose the direction d, which meets that light at
/// distance t with outward normal n.
inline Real pdf_light_of(const SceneView<T>& scene, std::uint32_t i, Int slot, Vec from, Real time,
                         Vec d, Real t, Vec n, Mask active) {
  const Row row{scene.rows + scene.row[i]};
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Disc:
      return pdf_disc(disc_at(row), from, d, t);
    case PrimitiveKind::Rectangle:
      return pdf_rectangle(rectangle_at(row), from);
    case PrimitiveKind::Triangle:
      return pdf_triangle(triangle_at(row), from);
    case PrimitiveKind::Mesh:
      return pdf_triangle(mesh_light(scene, i, slot, active).triangle, from);
    default:
      return with_kind(scene, i, [&]<PrimitiveKind kKind>() -> Real {
        if constexpr (is_planar(kKind)) {
          return Real(0);
        } else {
          return pdf_solid<kKind>(row, from, time, d, n);
        }
      });
  }
}

/// Each active lane's own light; valid only there.
inline LightSample sample_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time,
                                Vec2 u, Mask active) {
  LightSample s{Vec(Real(0)), Vec(Real(0)), Real(1), Real(1), Mask(false)};
  for_each_distinct(place.primitive, active, [&](std::uint32_t i, Mask m) {
    const LightSample r = sample_light_of(scene, i, place.slot, from, time, u, m);
    s.d = select(m, r.d, s.d);
    s.n = select(m, r.n, s.n);
    s.distance = select(m, r.distance, s.distance);
    s.pdf = select(m, r.pdf, s.pdf);
    s.valid = select(m, r.valid, s.valid);
  });
  return s;
}

/// Samples of the lights that the points themselves are on (`left` says which surface that is; from
/// its inside where `inside`), in place of those that `s` has. On which side the coordinates of
/// such a point lie is a matter of rounding, so nothing is asked of them: a solid's inner side sees
/// all of it and in all directions (kPdfSphere), everything else nothing of itself.
[[gnu::noinline]] inline void sample_own_lights(const SceneView<T>& scene, LightPlace place,
                                                const Ray& left, Vec from, Vec2 u, Mask inside,
                                                Mask own, LightSample& s) {
  for_each_distinct(place.primitive, own, [&](std::uint32_t i, Mask m) {
    const auto kind = static_cast<PrimitiveKind>(scene.kind[i]);
    if (kind == PrimitiveKind::Mesh) m = m && place.slot == left.from_slot;
    s.valid = s.valid && !m;
    m = m && inside;
    if (kind == PrimitiveKind::Mesh || is_planar(kind) || none(m)) return;
    const Ray ray = probe_ray(from, square_to_sphere(u), left.time);
    const Interval span = solid_interval(scene, i, ray);
    const NearestHit hit{span.far, Int(i), Int(0U), Real(0), Real(0)};
    const Vec n = surface_of(scene, i, ray, hit, m, Coordinates::None).ng;
    const Mask valid = span.hit && span.far > Real(0);
    s = select(m, LightSample{ray.d, n, span.far, Real(kPdfSphere), valid}, s);
  });
}

/// 0 where !active.
inline Real pdf_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time, Vec d,
                      Real t, Vec n, Mask active) {
  Real pdf(0);
  for_each_distinct(place.primitive, active, [&](std::uint32_t i, Mask m) {
    pdf = select(m, pdf_light_of(scene, i, place.slot, from, time, d, t, n, m), pdf);
  });
  return pdf;
}

LIGHTBENCH_KERNEL_END
