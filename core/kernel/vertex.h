#pragma once
// Where a path is: the surface that its ray met, or a point in a medium.

#include "core/accel/hit_surface.h"
#include "core/kernel/uses.h"
#include "core/materials/bsdf.h"
#include "core/textures/texture.h"

LIGHTBENCH_KERNEL_BEGIN

/// Where the paths scatter next: a surface point or a point in a medium.
struct Vertex {
  Surface surface;
  Material material;  ///< textures applied
  Vec object_point;   ///< where solid textures are read, in object space; only where they are used
  Vec wo;
  Vec ng, n;   ///< geometric and shading normal on the side of wo
  Mask front;  ///< wo is outside
  Mask on_surface, in_medium;
  Vec reflect_from;  ///< origin of rays that leave on the side of wo
  Real offset;
};

/// Surface and material of the hits, with textures.
inline void find_surface(const SceneView<T>& scene, const Ray& ray, const NearestHit& hit,
                         Mask active, Vertex& v) {
  const Int primitive = select(active, hit.primitive, Int(0U));
  v.material = materials_of(scene, pick(scene.material, primitive), active);
  v.offset = select(active, pick(scene.offset, primitive), Real(0));
  find_surfaces(scene, ray, hit, active,
                Mask(uses(scene, Feature::Coordinates)) && is_textured(v.material), v.surface);
  v.object_point = Vec(Real(0));
  if (uses(scene, Feature::SolidTextures)) {
    // Below the surface by what rounding may make of the point and its map: a face in the plane
    // between two cells of a checker, or a sphere that touches it, would show both at random.
    const Vec p = madd(v.surface.ng, T(-2) * v.offset, v.surface.p);
    for_each_distinct(primitive, active, [&](std::uint32_t i, Mask m) {
      const Affine to_object = affine_at(Row{scene.to_object + std::size_t{12} * i}, 0);
      v.object_point = select(m, to_object.point(p), v.object_point);
    });
  }
  const auto apply = [&](Int texture, Vec& color) {
    const Mask textured = active && texture != Int(kNoTexture);
    if (none(textured)) return;
    const Vec value =
        eval_texture(scene, texture, v.surface.u, v.surface.v, v.object_point, textured);
    color = select(textured, color * value, color);
  };
  if (uses(scene, Feature::Textures)) apply(v.material.base_color_texture, v.material.base_color);
  if (uses(scene, Feature::EmissionTextures))
    apply(v.material.emission_texture, v.material.emission);
}

/// Where a ray starts that leaves surface point p on the side that the geometric normal n points
/// to (with -offset: on the other side); `offset` bounds the error of p.
inline Vec leave_surface(Vec p, Vec n, Real offset) { return madd(n, offset, p); }

LIGHTBENCH_KERNEL_END
