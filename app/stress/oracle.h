#pragma once
// Rays and shapes in long double, to judge the kernels by: textbook formulas, written for precision
// and not for speed, that share nothing with core/shapes but the definition of each shape.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "core/query/rays.h"
#include "core/scene/scene.h"

namespace lightbench::stress {

using Number = long double;
using V = glm::vec<3, Number>;
using Matrix = glm::mat<4, 4, Number>;

/// A ray as the kernel sees it; d is unit but for the rounding of its components.
struct OracleRay {
  V o, d;
};
OracleRay exact_ray(const RenderScene& scene, const Ray& ray);
/// The same ray in the space of an object.
OracleRay into_object(const OracleRay& ray, const Matrix& world_to_object);

V exact_position(const Hit& hit);
/// Length of the way to the hit: t counts in the ray's own direction, which is unit only about.
Number told_distance(const Ray& ray, const Hit& hit);

/// Interval of a ray inside a solid (sphere, cylinder, box, pyramid).
struct Span {
  bool hit = false;
  Number near = 0, far = 0;
};
/// Of the solid whose faces are all moved outward by `grow` (inward below 0).
Span solid_span(const Shape& shape, const OracleRay& ray, Number grow = 0);
/// How far p is outside the solid's surface; negative inside.
Number outside_of(const Shape& shape, const V& p);
/// How far p is off the plane or the curved surface of the face with unit normal n, its borders
/// left out of account; any shape but a mesh.
Number off_face(const Shape& shape, const V& p, const V& n);
/// Outward normal of the face that p is on or nearest to.
V solid_normal(const Shape& shape, const V& p);

/// Where a ray meets the plane of a flat shape (disc, rectangle, triangle).
struct PlanePoint {
  Number t = 0;
  Number inside = 0;  ///< distance from the border, negative beyond it
  V normal{0};        ///< unit, of the front
};
/// NaN or infinite where the ray is parallel.
PlanePoint flat_point(const Shape& shape, const OracleRay& ray);
/// Distance of p from the plane of a flat shape.
Number off_plane(const Shape& shape, const V& p);

/// For the lines of failing cases.
std::string to_text(const glm::dvec3& v);
std::string to_text(const Ray& ray);
std::string to_text(const Shape& shape);

}  // namespace lightbench::stress
