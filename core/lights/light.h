#pragma once
// Sampling of directions to a light, by its shape. Every pdf here is the density of its sampler, in
// solid angle.

#include "core/accel/hit_surface.h"
#include "core/accel/primitive_hit.h"

LIGHTBENCH_KERNEL_BEGIN

/// Which primitive (and triangle slot of a mesh) a light is.
struct LightPlace {
  Int primitive, slot;
};
inline LightPlace place_of(const SceneView<T>& scene, Int light) {
  return {pick(scene.light_primitive, light),
          uses(scene, Feature::Meshes) ? gather(scene.light_slot, light) : Int(0U)};
}

/// World-space triangles of mesh lights and their outward normals.
struct MeshLight {
  Triangle triangle;
  Vec n;
};
inline MeshLight mesh_light(const SceneView<T>& scene, LightPlace place, Mask active) {
  const MeshInstance instance =
      mesh_at(rows_of<PrimitiveKind::Mesh>(scene, place.primitive, active));
  const Triangle t = fetch_vertices(scene, place.primitive, place.slot, active);
  return {to_world(instance, t),
          normalize(instance.to_local.transposed(cross(t.b - t.a, t.c - t.a)))};
}

/// Directions from `from` to lights whose shapes are all of one kind. Out of line, as their density
/// is: in line, the rarer shapes cost the headline scene time that it does not spend in them.
template <PrimitiveKind kKind>
[[gnu::noinline]] inline LightSample sample_light_of_kind(const SceneView<T>& scene,
                                                          LightPlace place, Vec from, Real time,
                                                          Vec2 u, Mask active) {
  if constexpr (kKind == PrimitiveKind::Mesh) {
    const MeshLight light = mesh_light(scene, place, active);
    LightSample s = sample_triangle(light.triangle, from, u);
    s.n = light.n;
    return s;
  } else {
    const auto row = rows_of<kKind>(scene, place.primitive, active);
    const auto shape = shape_at<kKind>(row, time);
    if constexpr (kKind == PrimitiveKind::Sphere) return sample_sphere(shape, from, u);
    if constexpr (kKind == PrimitiveKind::Ellipsoid)
      return sample_ellipsoid(shape, axes_of_ellipsoid(row), from, u);
    if constexpr (kKind == PrimitiveKind::Cylinder) return sample_cylinder(shape, from, u);
    if constexpr (kKind == PrimitiveKind::EllipticCylinder)
      return sample_elliptic_cylinder(shape, from, u);
    if constexpr (kKind == PrimitiveKind::Disc) return sample_disc(shape, from, u, active);
    if constexpr (kKind == PrimitiveKind::Rectangle) return sample_rectangle(shape, from, u);
    if constexpr (kKind == PrimitiveKind::Triangle) return sample_triangle(shape, from, u);
    if constexpr (kKind == PrimitiveKind::Pyramid) return sample_pyramid(shape, from, u);
    if constexpr (kKind == PrimitiveKind::Box) return sample_box(shape, from, u);
  }
}

/// Density with which that would choose the directions d, which meet the lights at distance t with
/// outward normal n.
template <PrimitiveKind kKind>
[[gnu::noinline]] inline Real pdf_light_of_kind(const SceneView<T>& scene, LightPlace place,
                                                Vec from, Real time, Vec d, [[maybe_unused]] Real t,
                                                [[maybe_unused]] Vec n, Mask active) {
  if constexpr (kKind == PrimitiveKind::Mesh) {
    return pdf_triangle(mesh_light(scene, place, active).triangle, from);
  } else {
    const auto row = rows_of<kKind>(scene, place.primitive, active);
    const auto shape = shape_at<kKind>(row, time);
    if constexpr (kKind == PrimitiveKind::Sphere) return pdf_sphere(shape, from);
    if constexpr (kKind == PrimitiveKind::Ellipsoid)
      return pdf_ellipsoid(shape, axes_of_ellipsoid(row), from, d);
    if constexpr (kKind == PrimitiveKind::Cylinder) return pdf_cylinder(shape, from, d, n);
    if constexpr (kKind == PrimitiveKind::EllipticCylinder)
      return pdf_elliptic_cylinder(shape, from, d, n);
    if constexpr (kKind == PrimitiveKind::Disc) return pdf_disc(shape, from, d, t, active);
    if constexpr (kKind == PrimitiveKind::Rectangle) return pdf_rectangle(shape, from);
    if constexpr (kKind == PrimitiveKind::Triangle) return pdf_triangle(shape, from);
    if constexpr (kKind == PrimitiveKind::Pyramid) return pdf_pyramid(shape, from);
    if constexpr (kKind == PrimitiveKind::Box) return pdf_box(shape, from);
  }
}

/// Each active lane's own light; valid only there.
inline LightSample sample_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time,
                                Vec2 u, Mask active) {
  LightSample s{Vec(Real(0)), Vec(Real(0)), Real(1), Real(1), Mask(false)};
  for_each_kind(scene, place.primitive, active, [&]<PrimitiveKind kKind>(Mask m) {
    s = select(m, sample_light_of_kind<kKind>(scene, place, from, time, u, m), s);
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
    const Vec n = surface_of(scene, ray, hit, m, Mask(false)).ng;
    const Mask valid = span.hit && span.far > Real(0);
    s = select(m, LightSample{ray.d, n, span.far, Real(kPdfSphere), valid}, s);
  });
}

/// Where rays meet the lights of `place`, which are not meshes.
[[gnu::noinline]] inline LightSample meet_light(const SceneView<T>& scene, LightPlace place,
                                                const Ray& ray, Mask active) {
  NearestHit hit = no_hit(Real(kInfinity));
  for_each_distinct(place.primitive, active, [&](std::uint32_t i, Mask m) {
    with_kind(scene, i, [&]<PrimitiveKind kKind>() {
      test_primitive<false, kKind, TestOrder::Any>(scene, i, ray, m, hit);
    });
  });
  const Mask met = active && hit.primitive != Int(kNoHit);
  return {ray.d, surface_of(scene, ray, hit, met, Mask(false)).ng, hit.t, Real(1), met};
}

/// 0 where !active.
inline Real pdf_light(const SceneView<T>& scene, LightPlace place, Vec from, Real time, Vec d,
                      Real t, Vec n, Mask active) {
  Real pdf(0);
  for_each_kind(scene, place.primitive, active, [&]<PrimitiveKind kKind>(Mask m) {
    pdf = select(m, pdf_light_of_kind<kKind>(scene, place, from, time, d, t, n, m), pdf);
  });
  return pdf;
}

LIGHTBENCH_KERNEL_END
