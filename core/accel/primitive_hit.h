#pragma once
// Rays against analytic primitives: one primitive in all lanes at once, and a tiny scene's all.

#include <type_traits>

#include "core/accel/nearest_hit.h"
#include "core/accel/surfaces.h"
#include "core/shapes/any_shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// Interval of a solid of the given kind. Inlined by force: else trees of spheres are 2 % slower.
template <PrimitiveKind kKind>
[[gnu::always_inline]] inline Interval solid_interval(const auto& shape, const Ray& ray,
                                                      HitQuality quality) {
  if constexpr (kKind == PrimitiveKind::Sphere) return hit_sphere(shape, ray, quality).span;
  if constexpr (kKind == PrimitiveKind::Ellipsoid) return hit_ellipsoid(shape, ray).span;
  if constexpr (kKind == PrimitiveKind::Cylinder) return hit_cylinder(shape, ray, quality);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder) return hit_elliptic_cylinder(shape, ray);
  if constexpr (kKind == PrimitiveKind::Pyramid) return hit_pyramid(shape, ray);
  if constexpr (kKind == PrimitiveKind::Box) return hit_box(shape, ray);
}

/// Calls f.operator()<kind>() for the kind of primitive i, which is not a mesh.
template <class F>
auto with_kind(const SceneView<T>& scene, std::uint32_t i, F f) {
  switch (static_cast<PrimitiveKind>(scene.kind[i])) {
    case PrimitiveKind::Sphere:
      return f.template operator()<PrimitiveKind::Sphere>();
    case PrimitiveKind::Ellipsoid:
      return f.template operator()<PrimitiveKind::Ellipsoid>();
    case PrimitiveKind::Cylinder:
      return f.template operator()<PrimitiveKind::Cylinder>();
    case PrimitiveKind::EllipticCylinder:
      return f.template operator()<PrimitiveKind::EllipticCylinder>();
    case PrimitiveKind::Disc:
      return f.template operator()<PrimitiveKind::Disc>();
    case PrimitiveKind::Rectangle:
      return f.template operator()<PrimitiveKind::Rectangle>();
    case PrimitiveKind::Triangle:
      return f.template operator()<PrimitiveKind::Triangle>();
    case PrimitiveKind::Pyramid:
      return f.template operator()<PrimitiveKind::Pyramid>();
    default:
      return f.template operator()<PrimitiveKind::Box>();
  }
}

/// The same for a kind known only at run time, such as a medium's boundary.
inline Interval solid_interval(const SceneView<T>& scene, std::uint32_t i, const Ray& ray) {
  return with_kind(scene, i, [&]<PrimitiveKind kKind>() -> Interval {
    if constexpr (is_planar(kKind)) {
      return {Real(0), Real(0), Mask(false)};
    } else {
      const auto shape = shape_at<kKind>(Row{scene.rows + scene.row[i]}, ray.time);
      return solid_interval<kKind>(shape, ray, hit_quality(scene));
    }
  });
}

/// Of equal distances the primitive with the smaller index wins. Where primitives are tested by
/// rising index, the first simply stays.
enum class TestOrder { Rising, Any };

/// Rays against analytic primitives, whose index is `id` and whose numbers are `shape`.
template <bool kShadow, PrimitiveKind kKind, TestOrder kOrder>
inline void test_shape(Int id, const auto& shape, const Ray& ray, HitQuality quality, Mask active,
                       NearestHit& hit) {
  const Mask self = ray.from == id;
  const auto report = [&](Real t, Mask m) {
    Mask nearer = t < hit.t;
    if (kOrder == TestOrder::Any) nearer = nearer || (t == hit.t && id < hit.primitive);
    m = m && active && nearer;
    hit.t = select(m, t, hit.t);
    hit.primitive = select(m, id, hit.primitive);
    return m;
  };
  if constexpr (is_planar(kKind)) {
    const Mask barred = kShadow ? self || ray.skip == id : self;
    if constexpr (kKind == PrimitiveKind::Triangle) {
      const TriangleHit h = hit_triangle(shape, ray);
      const Mask m = report(h.t, h.hit && !barred && h.t > Real(0));
      hit.b1 = select(m, h.b1, hit.b1);
      hit.b2 = select(m, h.b2, hit.b2);
    } else {
      PlaneHit h;
      if constexpr (kKind == PrimitiveKind::Disc) h = hit_disc(shape, ray);
      if constexpr (kKind == PrimitiveKind::Rectangle) h = hit_rectangle(shape, ray);
      report(h.t, h.hit && !barred && h.t > Real(0));
    }
  } else {
    const Interval s = solid_interval<kKind>(shape, ray, quality);
    Mask entry = s.hit && s.near > Real(0) && !self;
    Mask exit = s.hit && s.far > Real(0) && (!self || ray.inside);
    if (kShadow) {
      const Mask target = ray.skip == id;
      entry = entry && (!target || ray.skip_back);
      exit = exit && !target;
    }
    report(select(entry, s.near, s.far), entry || exit);
  }
}

/// Ray against analytic primitive i in all active lanes. Inlined by force: it has several callers.
template <bool kShadow, PrimitiveKind kKind, TestOrder kOrder>
[[gnu::always_inline]] inline void test_primitive(const SceneView<T>& scene, std::uint32_t i,
                                                  const Ray& ray, HitQuality quality, Mask active,
                                                  NearestHit& hit) {
  const auto shape = shape_at<kKind>(Row{scene.rows + scene.row[i]}, ray.time);
  test_shape<kShadow, kKind, kOrder>(Int(i), shape, ray, quality, active, hit);
}
template <bool kShadow, PrimitiveKind kKind, TestOrder kOrder>
[[gnu::always_inline]] inline void test_primitive(const SceneView<T>& scene, std::uint32_t i,
                                                  const Ray& ray, Mask active, NearestHit& hit) {
  test_primitive<kShadow, kKind, kOrder>(scene, i, ray, hit_quality(scene), active, hit);
}

/// Surfaces [begin, end), all of one kind. Out of line, so that a kind which the scene lacks costs
/// the one comparison of test_kind().
template <bool kShadow, PrimitiveKind kKind, HitQuality kQuality>
[[gnu::noinline]] inline void test_run(const SceneView<T>& scene, std::uint32_t begin,
                                       std::uint32_t end, const Ray& ray, const Surfaces& surfaces,
                                       Mask active, NearestHit& hit) {
  // Kept in registers where there are enough; through memory each hit waits for the one before.
  std::conditional_t<kManyRegisters, NearestHit, NearestHit&> nearest = hit;
  for (std::uint32_t i = begin; i < end; ++i) {
    if (!kShadow && surfaces.among[i] == 0) continue;
    test_primitive<kShadow, kKind, TestOrder::Rising>(scene, i, ray, kQuality, active, nearest);
  }
  if constexpr (kManyRegisters) hit = nearest;
}

/// All surfaces of one kind; for shadow rays, all that can be in the way.
template <bool kShadow, PrimitiveKind kKind>
inline void test_kind(const SceneView<T>& scene, const Ray& ray, const Surfaces& surfaces,
                      Mask active, NearestHit& hit) {
  constexpr auto k = static_cast<unsigned>(kKind);
  const std::uint32_t begin = scene.kind_begin[k];
  const std::uint32_t end = kShadow ? scene.occluders_end[k] : scene.kind_begin[k + 1];
  if (begin >= end) return;
  if constexpr (kKind == PrimitiveKind::Sphere || kKind == PrimitiveKind::Cylinder) {
    if (uses(scene, Feature::RefinedHits))
      return test_run<kShadow, kKind, HitQuality::Refined>(scene, begin, end, ray, surfaces, active,
                                                           hit);
  }
  test_run<kShadow, kKind, HitQuality::Plain>(scene, begin, end, ray, surfaces, active, hit);
}

/// Every surface against all lanes.
template <bool kShadow>
void test_all(const SceneView<T>& scene, const Ray& ray, const Surfaces& surfaces, Mask active,
              NearestHit& hit) {
  test_kind<kShadow, PrimitiveKind::Sphere>(scene, ray, surfaces, active, hit);
  if constexpr (compiled(Feature::Ellipsoids))
    test_kind<kShadow, PrimitiveKind::Ellipsoid>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Cylinder>(scene, ray, surfaces, active, hit);
  if constexpr (compiled(Feature::Ellipsoids))
    test_kind<kShadow, PrimitiveKind::EllipticCylinder>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Disc>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Rectangle>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Triangle>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Pyramid>(scene, ray, surfaces, active, hit);
  test_kind<kShadow, PrimitiveKind::Box>(scene, ray, surfaces, active, hit);
}

LIGHTBENCH_KERNEL_END
