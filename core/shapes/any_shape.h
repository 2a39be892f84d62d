#pragma once
// The shapes by kind: which numbers describe each, and the primitives of many lanes sorted by kind.

#include "core/kernel/uses.h"
#include "core/shapes/box.h"
#include "core/shapes/cylinder.h"
#include "core/shapes/disc.h"
#include "core/shapes/mesh.h"
#include "core/shapes/pyramid.h"
#include "core/shapes/rectangle.h"
#include "core/shapes/sphere.h"
#include "core/shapes/triangle.h"

LIGHTBENCH_KERNEL_BEGIN

constexpr bool is_planar(PrimitiveKind kind) {
  return kind == PrimitiveKind::Disc || kind == PrimitiveKind::Rectangle ||
         kind == PrimitiveKind::Triangle;
}

/// The shape that a row (Row, LaneRow or GatheredRow) describes, at each ray's time unless nothing
/// moves.
template <PrimitiveKind kKind>
auto shape_at(const auto& row, [[maybe_unused]] Real time, [[maybe_unused]] bool moving = true) {
  if constexpr (kKind == PrimitiveKind::Sphere) return sphere_at(row, time, moving);
  if constexpr (kKind == PrimitiveKind::Ellipsoid) return ellipsoid_at(row, time);
  if constexpr (kKind == PrimitiveKind::Cylinder) return cylinder_at(row);
  if constexpr (kKind == PrimitiveKind::EllipticCylinder) return elliptic_cylinder_at(row);
  if constexpr (kKind == PrimitiveKind::Disc) return disc_at(row);
  if constexpr (kKind == PrimitiveKind::Rectangle) return rectangle_at(row);
  if constexpr (kKind == PrimitiveKind::Triangle) return triangle_at(row);
  if constexpr (kKind == PrimitiveKind::Pyramid) return pyramid_at(row);
  if constexpr (kKind == PrimitiveKind::Box) return box_at(row);
  if constexpr (kKind == PrimitiveKind::Mesh) return mesh_at(row);
}

/// Numbers that describe a shape of the kind.
template <PrimitiveKind kKind>
inline constexpr unsigned kRowOf = decltype(shape_at<kKind>(Row{}, Real(0)))::kRow;

/// Where the rows of the lanes' surfaces, all of one kind (not meshes), begin in scene.rows: those
/// of a kind follow each other.
template <PrimitiveKind kKind>
Int row_offsets(const SceneView<T>& scene, Int surface) {
  const std::uint32_t first = scene.kind_begin[static_cast<unsigned>(kKind)];
  return (surface - Int(first)) * Int(kRowOf<kKind>) + Int(scene.row[first]);
}

/// Rows of the lanes' primitives, all of one kind.
template <PrimitiveKind kKind>
auto rows_of(const SceneView<T>& scene, Int primitive, Mask active) {
  constexpr unsigned kSize = kRowOf<kKind>;
  constexpr auto k = static_cast<unsigned>(kKind);
  if (scene.columns[k] != nullptr)
    return row_of_columns<kSize>(scene.columns[k], primitive - Int(scene.kind_begin[k]));
  return merged_rows<kSize>(primitive, active,
                            [&](std::uint32_t i) { return scene.rows + scene.row[i]; });
}

/// Calls f.operator()<kind>(lanes) for each kind among the active lanes' surfaces.
template <class F>
void for_each_kind(const SceneView<T>& scene, Int surface, Mask active, F f) {
  const auto call = [&]<PrimitiveKind kKind>() {
    constexpr auto k = static_cast<unsigned>(kKind);
    if (scene.kind_begin[k] == scene.kind_begin[k + 1]) return;
    const Mask m =
        active && surface >= Int(scene.kind_begin[k]) && surface < Int(scene.kind_begin[k + 1]);
    if (any(m)) f.template operator()<kKind>(m);
  };
  call.template operator()<PrimitiveKind::Sphere>();
  if constexpr (compiled(Feature::Ellipsoids)) {
    call.template operator()<PrimitiveKind::Ellipsoid>();
    call.template operator()<PrimitiveKind::EllipticCylinder>();
  }
  call.template operator()<PrimitiveKind::Cylinder>();
  call.template operator()<PrimitiveKind::Disc>();
  call.template operator()<PrimitiveKind::Rectangle>();
  call.template operator()<PrimitiveKind::Triangle>();
  call.template operator()<PrimitiveKind::Pyramid>();
  call.template operator()<PrimitiveKind::Box>();
  if constexpr (compiled(Feature::Meshes)) call.template operator()<PrimitiveKind::Mesh>();
}

LIGHTBENCH_KERNEL_END
