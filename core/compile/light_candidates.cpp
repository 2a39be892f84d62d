#include "core/compile/light_candidates.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <optional>

#include "core/compile/columns.h"
#include "core/compile/lenses.h"

namespace lightbench {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;
using glm::length;
using glm::normalize;

struct MirrorFace {
  dvec3 n, origin, u, v;
  MirrorOutline outline;
  std::uint32_t primitive;
  dvec3 color;

  [[nodiscard]] dvec3 dual_u() const {
    return cross(v, cross(u, v)) / dot(u, cross(v, cross(u, v)));
  }
  [[nodiscard]] dvec3 dual_v() const {
    return cross(cross(u, v), u) / dot(v, cross(cross(u, v), u));
  }
  /// Points whose hull holds the face.
  [[nodiscard]] std::vector<dvec3> corners() const {
    if (outline == MirrorOutline::Triangle) return {origin, origin + u, origin + v};
    if (outline == MirrorOutline::Disc)
      return {origin + u + v, origin + u - v, origin - u + v, origin - u - v};
    return {origin, origin + u, origin + v, origin + u + v};
  }
  [[nodiscard]] dvec3 mirrored(const dvec3& p) const { return p - 2 * dot(n, p - origin) * n; }
};

/// The faces of the plane-sided primitives that are ideal mirrors.
template <class T>
std::vector<MirrorFace> mirror_faces(const Scene& scene, const GeometryPart<T>& geometry) {
  std::vector<MirrorFace> faces;
  for (std::uint32_t i = 0; i < geometry.surface_count; ++i) {
    const Object& o = scene.objects[static_cast<std::size_t>(geometry.object[i])];
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    const bool ideal = m.kind == MaterialKind::Metal && m.fuzz <= 0 && m.roughness <= 0;
    if (!ideal || m.base_color_texture != kNone) continue;
    const Numbers<T> row(&geometry.rows[geometry.row[i]]);
    const auto add = [&](const dvec3& n, const dvec3& origin, const dvec3& u, const dvec3& v,
                         MirrorOutline outline) {
      faces.push_back({n, origin, u, v, outline, i, m.base_color});
    };
    const auto add_both_sides = [&](const dvec3& n, const dvec3& origin, const dvec3& u,
                                    const dvec3& v, MirrorOutline outline) {
      add(n, origin, u, v, outline);
      add(-n, origin, u, v, outline);
    };
    switch (static_cast<PrimitiveKind>(geometry.kind[i])) {
      case PrimitiveKind::Disc:
        add_both_sides(row.vec(3), row.vec(0), row.vec(6), row.vec(9), MirrorOutline::Disc);
        break;
      case PrimitiveKind::Rectangle:
        add_both_sides(row.vec(3), row.vec(0), row.vec(6), row.vec(9),
                       MirrorOutline::Parallelogram);
        break;
      case PrimitiveKind::Triangle: {
        const dvec3 a = row.vec(0), u = row.vec(3) - a, v = row.vec(6) - a;
        add_both_sides(normalize(cross(u, v)), a, u, v, MirrorOutline::Triangle);
        break;
      }
      case PrimitiveKind::Pyramid: {
        const dvec3 tip = row.vec(0), a = row.vec(3), b = row.vec(6), c = row.vec(9);
        add(row.vec(12), tip + a, b - a, c - a, MirrorOutline::Triangle);
        add(row.vec(15), tip, b, c, MirrorOutline::Triangle);
        add(row.vec(18), tip, a, c, MirrorOutline::Triangle);
        add(row.vec(21), tip, a, b, MirrorOutline::Triangle);
        break;
      }
      case PrimitiveKind::Box:
        for (std::size_t k = 0; k < 3; ++k) {
          const auto half = [&](std::size_t a) { return row.vec(3 + 3 * a) * row[12 + a]; };
          const dvec3 out = half(k), u = half((k + 1) % 3), v = half((k + 2) % 3);
          for (const double side : {1.0, -1.0}) {
            add(row.vec(3 + 3 * k) * side, row.vec(0) + side * out - u - v, 2.0 * u, 2.0 * v,
                MirrorOutline::Parallelogram);
          }
        }
        break;
      default:
        break;
    }
  }
  return faces;
}

/// Whether light of the lamp can fall on the front of the face.
bool can_light(const Lamp& lamp, const MirrorFace& face) {
  const double height = dot(face.n, lamp.place.center - face.origin);
  if (height + lamp.place.extent(face.n) <= 0) return false;
  if (lamp.place.normal == dvec3(0) || lamp.two_sided) return true;
  const auto corners = face.corners();
  return std::any_of(corners.begin(), corners.end(), [&](const dvec3& p) {
    return dot(lamp.place.normal, p - lamp.place.center) > 0;
  });
}

template <class T>
void append_candidate(const Lamp& lamp, std::uint32_t light, const MirrorFace* face, int mirror,
                      std::vector<T>& rows) {
  const LightPlacement& p = lamp.place;
  dvec3 center = p.center, normal = p.normal, window(0), extent(0);
  double weight = lamp.weight;
  if (face != nullptr) {
    center = face->mirrored(center);
    normal -= 2 * dot(face->n, normal) * face->n;
    const dvec3 w[3] = {face->dual_u(), face->dual_v(), face->n};
    for (int k = 0; k < 3; ++k) {
      window[k] = dot(w[k], p.center - face->origin);
      extent[k] = p.extent(w[k]);
    }
    // Of a light that the mirror's plane cuts, the part in front.
    window.z = std::max(window.z, 0.25 * extent.z);
    weight *= luminance(face->color);
  }
  const double radius = p.radius();
  const double numbers[kLightCandidateStride] = {center.x,
                                                 center.y,
                                                 center.z,
                                                 normal.x,
                                                 normal.y,
                                                 normal.z,
                                                 radius,
                                                 weight,
                                                 double(light),
                                                 double(mirror),
                                                 lamp.two_sided ? 1.0 : 0.0,
                                                 window.x,
                                                 window.y,
                                                 window.z,
                                                 extent.x,
                                                 extent.y,
                                                 extent.z,
                                                 face != nullptr ? 1 / window.z : 0.0,
                                                 0.25 / radius};
  for (const double x : numbers) rows.push_back(static_cast<T>(x));
}

/// Seen through a lens: the table in place of a window.
template <class T>
void append_candidate(const Lamp& lamp, std::uint32_t light, const GlassSphere& sphere, int lens,
                      std::vector<T>& rows) {
  append_candidate(lamp, light, nullptr, lens, rows);
  T* row = &rows[rows.size() - kLightCandidateStride];
  row[10] = static_cast<T>(1 / glm::distance(lamp.place.center, sphere.middle()));
  const auto turns = lens_turns(lamp, sphere);
  std::transform(turns.begin(), turns.end(), row + 11, [](double x) { return static_cast<T>(x); });
}

template <class T>
void append_mirror(const MirrorFace& face, T offset, std::vector<T>& rows) {
  for (const dvec3& v : {face.n, face.origin, face.dual_u(), face.dual_v()}) {
    for (int k = 0; k < 3; ++k) rows.push_back(static_cast<T>(v[k]));
  }
  rows.push_back(static_cast<T>(face.outline));
  rows.push_back(static_cast<T>(face.primitive));
  for (int k = 0; k < 3; ++k) rows.push_back(static_cast<T>(face.color[k]));
  rows.push_back(offset);
}

}  // namespace

template <class T>
void add_light_candidates(const Scene& scene, const GeometryPart<T>& geometry,
                          const std::vector<Lamp>& lamps, LightPart<T>& lights) {
  const std::size_t count = lamps.size();
  if (count == 0) return;
  const auto light_index = [](std::size_t l) { return static_cast<std::uint32_t>(l); };
  for (std::size_t l = 0; l < count; ++l) {
    append_candidate(lamps[l], light_index(l), nullptr, -1, lights.candidates);
  }
  lights.direct_candidates = light_index(count);

  std::uint32_t candidates = lights.direct_candidates;
  // Candidates for the lamps that `can_light`, by one way more; false where there are none, or more
  // than the table has room for.
  const auto add_images = [&](auto can_light, auto append) {
    std::vector<std::uint32_t> of_lights(count, kNoLight);
    std::uint32_t end = candidates;
    for (std::size_t l = 0; l < count; ++l) {
      if (lamps[l].weight > 0 && can_light(l)) of_lights[l] = end++;
    }
    if (end == candidates || end > kMaxLightCandidates) return false;
    for (std::size_t l = 0; l < count; ++l) {
      if (of_lights[l] != kNoLight) append(l);
    }
    candidates = end;
    lights.image_candidate.insert(lights.image_candidate.end(), of_lights.begin(), of_lights.end());
    return true;
  };
  for (const MirrorFace& face : mirror_faces(scene, geometry)) {
    const auto mirror = static_cast<int>(lights.mirror_end.size());
    const bool added = add_images(
        [&](std::size_t l) {
          return lights.primitive[l] != face.primitive && can_light(lamps[l], face);
        },
        [&](std::size_t l) {
          append_candidate(lamps[l], light_index(l), &face, mirror, lights.candidates);
        });
    if (!added) continue;
    lights.mirror_end.push_back(candidates);
    append_mirror(face, geometry.offset[face.primitive], lights.mirrors);
  }
  append_columns(lights.mirrors.data(), lights.mirror_end.size(), kMirrorStride,
                 lights.mirror_columns);
  lights.first_lens_candidate = candidates;
  for (const GlassSphere& sphere : glass_spheres(scene, geometry)) {
    const auto lens = static_cast<int>(lights.mirror_end.size() + lights.lens_end.size());
    const bool added = add_images(
        [&](std::size_t l) {
          const auto kind = static_cast<PrimitiveKind>(geometry.kind[lights.primitive[l]]);
          return kind != PrimitiveKind::Mesh && can_light(lamps[l], sphere);
        },
        [&](std::size_t l) {
          append_candidate(lamps[l], light_index(l), sphere, lens, lights.candidates);
          for (const double x : lens_table(lamps[l], sphere)) {
            lights.lens_tables.push_back(static_cast<T>(x));
          }
        });
    if (!added) continue;
    lights.lens_end.push_back(candidates);
    append_lens(sphere, geometry.offset[sphere.primitive], lights.lenses);
  }
  if (count == 1 && lights.mirror_end.empty() && lights.lens_end.empty()) {
    lights.candidates.clear();
    lights.direct_candidates = 0;
  }
}

template void add_light_candidates(const Scene&, const GeometryPart<float>&,
                                   const std::vector<Lamp>&, LightPart<float>&);
template void add_light_candidates(const Scene&, const GeometryPart<double>&,
                                   const std::vector<Lamp>&, LightPart<double>&);

}  // namespace lightbench
