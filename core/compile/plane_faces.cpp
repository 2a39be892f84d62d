#include "core/compile/plane_faces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lightbench {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;
using glm::normalize;

/// Points whose hull holds the face.
std::vector<dvec3> corners(const PlaneFace& f) {
  if (f.outline == FaceOutline::Triangle) return {f.origin, f.origin + f.u, f.origin + f.v};
  if (f.outline == FaceOutline::Disc) {
    return {f.origin + f.u + f.v, f.origin + f.u - f.v, f.origin - f.u + f.v, f.origin - f.u - f.v};
  }
  return {f.origin, f.origin + f.u, f.origin + f.v, f.origin + f.u + f.v};
}

/// Both sides of each axis.
template <class T>
std::vector<PlaneFace> box_faces(const Numbers<T>& row, std::uint32_t primitive,
                                 const dvec3& color) {
  std::vector<PlaneFace> faces;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto half = [&](std::size_t a) { return row.vec(3 + 3 * a) * row[12 + a]; };
    const dvec3 out = half(k), u = half((k + 1) % 3), v = half((k + 2) % 3);
    for (const double side : {1.0, -1.0}) {
      faces.push_back({row.vec(3 + 3 * k) * side, row.vec(0) + side * out - u - v, 2.0 * u, 2.0 * v,
                       FaceOutline::Parallelogram, primitive, color});
    }
  }
  return faces;
}

}  // namespace

dvec3 PlaneFace::dual_u() const { return cross(v, cross(u, v)) / dot(u, cross(v, cross(u, v))); }
dvec3 PlaneFace::dual_v() const { return cross(cross(u, v), u) / dot(v, cross(cross(u, v), u)); }

template <class T>
std::vector<PlaneFace> pane_faces(const Scene& scene, const GeometryPart<T>& geometry,
                                  const ObjectBoxes& boxes) {
  std::vector<PlaneFace> faces;
  unsigned seen = 0;
  for (std::uint32_t i = 0; i < geometry.surface_count && seen < kMaxWithImages; ++i) {
    if (static_cast<PrimitiveKind>(geometry.kind[i]) != PrimitiveKind::Box) continue;
    const auto object = static_cast<std::size_t>(geometry.object[i]);
    const Material& m = scene.materials[static_cast<std::size_t>(scene.objects[object].material)];
    if (!is_clear_glass(m)) continue;
    ++seen;
    const Interior interior = boxes.interior(object);
    if (interior == Interior::Hollow) continue;
    const Numbers<T> row(&geometry.rows[geometry.row[i]]);
    const std::vector<PlaneFace> sides = box_faces(row, i, m.base_color * m.base_color);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      PlaneFace face = sides[k];
      if (!boxes.any_before(object, face.n, geometry.space.to_scene(face.origin))) continue;
      face.thickness = 2 * row[12 + k / 2];
      face.ior = m.ior;
      face.crowded = interior == Interior::Crowded;
      faces.push_back(face);
    }
  }
  return faces;
}

template <class T>
std::vector<PlaneFace> mirror_faces(const Scene& scene, const GeometryPart<T>& geometry) {
  std::vector<PlaneFace> faces;
  for (std::uint32_t i = 0; i < geometry.surface_count; ++i) {
    const Object& o = scene.objects[static_cast<std::size_t>(geometry.object[i])];
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    const bool ideal = m.kind == MaterialKind::Metal && m.fuzz <= 0 && m.roughness <= 0;
    if (!ideal || m.base_color_texture != kNone) continue;
    const Numbers<T> row(&geometry.rows[geometry.row[i]]);
    const auto add = [&](const dvec3& n, const dvec3& origin, const dvec3& u, const dvec3& v,
                         FaceOutline outline) {
      faces.push_back({n, origin, u, v, outline, i, m.base_color});
    };
    const auto add_both_sides = [&](const dvec3& n, const dvec3& origin, const dvec3& u,
                                    const dvec3& v, FaceOutline outline) {
      add(n, origin, u, v, outline);
      add(-n, origin, u, v, outline);
    };
    switch (static_cast<PrimitiveKind>(geometry.kind[i])) {
      case PrimitiveKind::Disc:
        add_both_sides(row.vec(3), row.vec(0), row.vec(6), row.vec(9), FaceOutline::Disc);
        break;
      case PrimitiveKind::Rectangle:
        add_both_sides(row.vec(3), row.vec(0), row.vec(6), row.vec(9), FaceOutline::Parallelogram);
        break;
      case PrimitiveKind::Triangle: {
        const dvec3 a = row.vec(0), u = row.vec(3) - a, v = row.vec(6) - a;
        add_both_sides(normalize(cross(u, v)), a, u, v, FaceOutline::Triangle);
        break;
      }
      case PrimitiveKind::Pyramid: {
        const dvec3 tip = row.vec(0), a = row.vec(3), b = row.vec(6), c = row.vec(9);
        add(row.vec(12), tip + a, b - a, c - a, FaceOutline::Triangle);
        add(row.vec(15), tip, b, c, FaceOutline::Triangle);
        add(row.vec(18), tip, a, c, FaceOutline::Triangle);
        add(row.vec(21), tip, a, b, FaceOutline::Triangle);
        break;
      }
      case PrimitiveKind::Box:
        for (const PlaneFace& face : box_faces(row, i, m.base_color)) faces.push_back(face);
        break;
      default:
        break;
    }
  }
  return faces;
}

bool can_light(const Lamp& lamp, const PlaneFace& face) {
  const bool pane = face.thickness > 0;
  const dvec3 out = pane ? -face.n : face.n;
  const dvec3 lit_side = pane ? face.thickness * out : dvec3(0);  // from the front
  const double height = dot(out, lamp.place.center - face.origin - lit_side);
  if (height + lamp.place.extent(out) <= 0) return false;
  if (lamp.place.normal == dvec3(0) || lamp.two_sided) return true;
  const auto points = corners(face);
  return std::any_of(points.begin(), points.end(), [&](const dvec3& p) {
    return dot(lamp.place.normal, p + lit_side - lamp.place.center) > 0;
  });
}

template <class T>
void append_face(const PlaneFace& face, T offset, std::vector<T>& rows) {
  for (const dvec3& v : {face.n, face.origin, face.dual_u(), face.dual_v()}) {
    for (int k = 0; k < 3; ++k) rows.push_back(static_cast<T>(v[k]));
  }
  rows.push_back(static_cast<T>(face.outline));
  rows.push_back(static_cast<T>(face.primitive));
  for (int k = 0; k < 3; ++k) rows.push_back(static_cast<T>(face.color[k]));
  rows.push_back(offset);
  for (const double x : {face.thickness, face.ior, face.crowded ? 1.0 : 0.0})
    rows.push_back(static_cast<T>(x));
}

template std::vector<PlaneFace> mirror_faces(const Scene&, const GeometryPart<float>&);
template std::vector<PlaneFace> mirror_faces(const Scene&, const GeometryPart<double>&);
template std::vector<PlaneFace> pane_faces(const Scene&, const GeometryPart<float>&,
                                           const ObjectBoxes&);
template std::vector<PlaneFace> pane_faces(const Scene&, const GeometryPart<double>&,
                                           const ObjectBoxes&);
template void append_face(const PlaneFace&, float, std::vector<float>&);
template void append_face(const PlaneFace&, double, std::vector<double>&);

}  // namespace lightbench
