#include "core/compile/light_place.h"

#include <algorithm>
#include <cmath>

namespace lightbench {
namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;
using glm::length;
using glm::normalize;

LightPlacement hull(std::initializer_list<dvec3> points) {
  LightPlacement p;
  for (const dvec3& q : points) p.center += q / static_cast<double>(points.size());
  for (const dvec3& q : points) p.spread.push_back(q - p.center);
  return p;
}

LightPlacement ellipsoid(const dvec3& center, std::initializer_list<dvec3> axes) {
  return {center, dvec3(0), axes, true};
}

/// Of the primitive that the row describes; of a mesh, the triangle in `slot`.
template <class T>
LightPlacement place_of(const GeometryPart<T>& geometry, std::uint32_t primitive,
                        std::uint32_t slot, const MeshPart<T>* mesh) {
  const Numbers<T> row(&geometry.rows[geometry.row[primitive]]);
  switch (static_cast<PrimitiveKind>(geometry.kind[primitive])) {
    case PrimitiveKind::Sphere: {
      // Anywhere on its way.
      const double r = row[3];
      LightPlacement p =
          ellipsoid(row.vec(0) + 0.5 * row.vec(4), {{r, 0, 0}, {0, r, 0}, {0, 0, r}});
      p.spread.push_back(0.5 * row.vec(4));
      return p;
    }
    case PrimitiveKind::Ellipsoid: {
      const glm::dmat3 m = row.linear(12);
      LightPlacement p = ellipsoid(row.translation(12) + 0.5 * row.vec(24), {m[0], m[1], m[2]});
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
      LightPlacement p = ellipsoid(row.vec(0), {row.vec(6), row.vec(9)});
      p.normal = row.vec(3);
      return p;
    }
    case PrimitiveKind::Rectangle: {
      const dvec3 o = row.vec(0), u = row.vec(6), v = row.vec(9);
      LightPlacement p = hull({o, o + u, o + u + v, o + v});
      p.normal = row.vec(3);
      return p;
    }
    case PrimitiveKind::Triangle: {
      const dvec3 a = row.vec(0), b = row.vec(3), c = row.vec(6);
      LightPlacement p = hull({a, b, c});
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
  LightPlacement p = hull({v[0], v[1], v[2]});
  // The front follows the winding in object space.
  const double handed = glm::determinant(linear) < 0 ? -1 : 1;
  p.normal = normalize(cross(v[1] - v[0], v[2] - v[0])) * handed;
  return p;
}

}  // namespace

double LightPlacement::extent(const dvec3& w) const {
  double most = 0, squares = 0;
  for (const dvec3& s : spread) {
    most = std::max(most, std::abs(dot(w, s)));
    squares += dot(w, s) * dot(w, s);
  }
  return round ? std::sqrt(squares) : most;
}

double LightPlacement::radius() const {
  double most = 0;
  for (const dvec3& s : spread) most = std::max(most, length(s));
  return most;
}

template <class T>
std::vector<Lamp> find_lamps(const Scene& scene, const GeometryPart<T>& geometry,
                             const LightPart<T>& lights) {
  std::vector<Lamp> lamps;
  for (std::size_t l = 0; l < lights.primitive.size(); ++l) {
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
  return lamps;
}

template std::vector<Lamp> find_lamps(const Scene&, const GeometryPart<float>&,
                                      const LightPart<float>&);
template std::vector<Lamp> find_lamps(const Scene&, const GeometryPart<double>&,
                                      const LightPart<double>&);

}  // namespace lightbench
