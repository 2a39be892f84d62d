#include "core/compile/light_candidates.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <optional>

namespace lightbench {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;
using glm::length;
using glm::normalize;

/// More lights than this are chosen by power: each costs some nanoseconds at every vertex.
constexpr std::size_t kMostDirect = 16;

/// The numbers of a primitive's row, in double.
template <class T>
class Numbers {
 public:
  explicit Numbers(const T* row) : row_(row) {}
  double operator[](std::size_t i) const { return static_cast<double>(row_[i]); }
  [[nodiscard]] dvec3 vec(std::size_t i) const {
    return {(*this)[i], (*this)[i + 1], (*this)[i + 2]};
  }
  /// The columns of an affine map's linear part, and its translation.
  [[nodiscard]] glm::dmat3 linear(std::size_t i) const {
    return glm::transpose(glm::dmat3(vec(i), vec(i + 4), vec(i + 8)));
  }
  [[nodiscard]] dvec3 translation(std::size_t i) const {
    return {(*this)[i + 3], (*this)[i + 7], (*this)[i + 11]};
  }

 private:
  const T* row_;
};

/// Where a light is, roughly: the points center + sum of c_k spread_k, |c| <= 1 (an ellipsoid or
/// ellipse), or the hull of center + spread_k.
struct Place {
  dvec3 center{0};
  dvec3 normal{0};  ///< of flat lights, towards the front
  std::vector<dvec3> spread;
  bool round = false;

  /// How far it reaches along w from its center.
  [[nodiscard]] double extent(const dvec3& w) const {
    double most = 0, squares = 0;
    for (const dvec3& s : spread) {
      most = std::max(most, std::abs(dot(w, s)));
      squares += dot(w, s) * dot(w, s);
    }
    return round ? std::sqrt(squares) : most;
  }
  [[nodiscard]] double radius() const {
    double most = 0;
    for (const dvec3& s : spread) most = std::max(most, length(s));
    return most;
  }
};

Place hull(std::initializer_list<dvec3> points) {
  Place p;
  for (const dvec3& q : points) p.center += q / static_cast<double>(points.size());
  for (const dvec3& q : points) p.spread.push_back(q - p.center);
  return p;
}

Place ellipsoid(const dvec3& center, std::initializer_list<dvec3> axes) {
  return {center, dvec3(0), axes, true};
}

/// Of the primitive that the row describes; of a mesh, the triangle in `slot`.
template <class T>
Place place_of(const GeometryPart<T>& geometry, std::uint32_t primitive, std::uint32_t slot,
               const MeshPart<T>* mesh) {
  const Numbers<T> row(&geometry.rows[geometry.row[primitive]]);
  switch (static_cast<PrimitiveKind>(geometry.kind[primitive])) {
    case PrimitiveKind::Sphere: {
      // Anywhere on its way.
      const double r = row[3];
      Place p = ellipsoid(row.vec(0) + 0.5 * row.vec(4), {{r, 0, 0}, {0, r, 0}, {0, 0, r}});
      p.spread.push_back(0.5 * row.vec(4));
      return p;
    }
    case PrimitiveKind::Ellipsoid: {
      const glm::dmat3 m = row.linear(12);
      Place p = ellipsoid(row.translation(12) + 0.5 * row.vec(24), {m[0], m[1], m[2]});
      p.spread.push_back(0.5 * row.vec(24));
      return p;
    }
    case PrimitiveKind::Cylinder: {
      const dvec3 axis = row.vec(3), across = row.vec(6);
      return ellipsoid(row.vec(0),
                       {axis * row[9], across * row[10], cross(axis, across) * row[10]});
    }
    case PrimitiveKind::EllipticCylinder: {
      const glm::dmat3 m = row.linear(12);
      return ellipsoid(row.translation(12), {m[0], m[1], m[2]});
    }
    case PrimitiveKind::Disc: {
      Place p = ellipsoid(row.vec(0), {row.vec(6), row.vec(9)});
      p.normal = row.vec(3);
      return p;
    }
    case PrimitiveKind::Rectangle: {
      const dvec3 o = row.vec(0), u = row.vec(6), v = row.vec(9);
      Place p = hull({o, o + u, o + u + v, o + v});
      p.normal = row.vec(3);
      return p;
    }
    case PrimitiveKind::Triangle: {
      const dvec3 a = row.vec(0), b = row.vec(3), c = row.vec(6);
      Place p = hull({a, b, c});
      p.normal = normalize(cross(b - a, c - a)) * row[9];
      return p;
    }
    case PrimitiveKind::Pyramid: {
      const dvec3 o = row.vec(0);
      return hull({o, o + row.vec(3), o + row.vec(6), o + row.vec(9)});
    }
    case PrimitiveKind::Box: {
      const dvec3 o = row.vec(0), x = row.vec(3) * row[12], y = row.vec(6) * row[13],
                  z = row.vec(9) * row[14];
      return hull({o + x + y + z, o + x + y - z, o + x - y + z, o + x - y - z, o - x + y + z,
                   o - x + y - z, o - x - y + z, o - x - y - z});
    }
    case PrimitiveKind::Mesh:
      break;
  }
  dvec3 v[3];
  const glm::dmat3 linear = row.linear(12);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& block = mesh->blocks[slot / kBvhWidth];
    const auto at = [&](std::size_t k) {
      return static_cast<double>(block.v[3 * i + k][slot % kBvhWidth]);
    };
    v[i] = linear * dvec3(at(0), at(1), at(2)) + row.translation(12);
  }
  Place p = hull({v[0], v[1], v[2]});
  // The front follows the winding in object space.
  const double handed = glm::determinant(linear) < 0 ? -1 : 1;
  p.normal = normalize(cross(v[1] - v[0], v[2] - v[0])) * handed;
  return p;
}

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

struct Lamp {
  Place place;
  double weight;
  bool two_sided;
};

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
  const Place& p = lamp.place;
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
    weight *= dot(face->color, dvec3(0.2126, 0.7152, 0.0722));
  }
  const double numbers[kLightCandidateStride] = {center.x,
                                                 center.y,
                                                 center.z,
                                                 normal.x,
                                                 normal.y,
                                                 normal.z,
                                                 p.radius(),
                                                 weight,
                                                 double(light),
                                                 double(mirror),
                                                 lamp.two_sided ? 1.0 : 0.0,
                                                 window.x,
                                                 window.y,
                                                 window.z,
                                                 extent.x,
                                                 extent.y,
                                                 extent.z};
  for (const double x : numbers) rows.push_back(static_cast<T>(x));
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
                          LightPart<T>& lights) {
  const std::size_t count = lights.primitive.size();
  if (count == 0 || count > kMostDirect) return;
  std::vector<Lamp> lamps;
  for (std::size_t l = 0; l < count; ++l) {
    const std::uint32_t i = lights.primitive[l];
    const Object& o = scene.objects[static_cast<std::size_t>(geometry.object[i])];
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    const auto* mesh = std::get_if<MeshShape>(&o.shape);
    const MeshPart<T>* part =
        mesh == nullptr ? nullptr : geometry.meshes[static_cast<std::size_t>(mesh->mesh)].get();
    // Slots of a mesh that hold no triangle shine with no power and have no place.
    const bool empty = part != nullptr && part->slot_triangle[lights.slot[l]] == Bvh::kPadding;
    Lamp lamp{empty ? ellipsoid(dvec3(0), {dvec3(1)}) : place_of(geometry, i, lights.slot[l], part),
              static_cast<double>(lights.pmf[l]), m.two_sided};
    // The power of both sides, of all around; a point sees one side, a quarter of a convex solid.
    if (lamp.place.normal == dvec3(0)) {
      lamp.weight *= m.two_sided ? 0.125 : 0.25;
    } else if (m.two_sided) {
      lamp.weight *= 0.5;
    }
    lamps.push_back(std::move(lamp));
  }
  const auto light_index = [](std::size_t l) { return static_cast<std::uint32_t>(l); };
  for (std::size_t l = 0; l < count; ++l) {
    append_candidate(lamps[l], light_index(l), nullptr, -1, lights.candidates);
  }
  lights.direct_candidates = light_index(count);

  std::vector<T> images, mirrors;
  std::vector<std::uint32_t> mirror_end, image_candidate;
  std::uint32_t candidates = lights.direct_candidates;
  for (const MirrorFace& face : mirror_faces(scene, geometry)) {
    const auto mirror = static_cast<int>(mirror_end.size());
    const std::uint32_t before = candidates;
    std::vector<std::uint32_t> of_lights(count, kNoLight);
    for (std::size_t l = 0; l < count; ++l) {
      if (lamps[l].weight <= 0 || lights.primitive[l] == face.primitive ||
          !can_light(lamps[l], face)) {
        continue;
      }
      of_lights[l] = candidates++;
      append_candidate(lamps[l], light_index(l), &face, mirror, images);
    }
    if (candidates == before) continue;
    mirror_end.push_back(candidates);
    append_mirror(face, geometry.offset[face.primitive], mirrors);
    image_candidate.insert(image_candidate.end(), of_lights.begin(), of_lights.end());
  }
  if (candidates <= kMaxLightCandidates) {
    lights.candidates.insert(lights.candidates.end(), images.begin(), images.end());
    lights.mirrors = std::move(mirrors);
    lights.mirror_end = std::move(mirror_end);
    lights.image_candidate = std::move(image_candidate);
  }
  if (count == 1 && lights.mirror_end.empty()) {
    lights.candidates.clear();
    lights.direct_candidates = 0;
  }
}

template void add_light_candidates(const Scene&, const GeometryPart<float>&, LightPart<float>&);
template void add_light_candidates(const Scene&, const GeometryPart<double>&, LightPart<double>&);

}  // namespace lightbench
