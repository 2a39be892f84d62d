#pragma once
// Random shapes of about unit size around the origin, and points in, on and at the ends of them.

#include <vector>

#include "app/stress/random.h"
#include "core/scene/scene.h"

namespace lightbench::stress {

enum class Kind { Sphere, Cylinder, Pyramid, Box, Disc, Rectangle, Triangle, Mesh };
inline constexpr Kind kKinds[] = {Kind::Sphere, Kind::Cylinder,  Kind::Pyramid,  Kind::Box,
                                  Kind::Disc,   Kind::Rectangle, Kind::Triangle, Kind::Mesh};
const char* name_of(Kind kind);
/// Sphere, cylinder, pyramid, box: what the oracle knows as solids.
bool is_solid(Kind kind);

/// Any kind but a mesh. Coordinates are multiples of 2^-10, which float holds exactly.
Shape random_shape(Random& random, Kind kind);
/// A pyramid or box about a thousandth as thick as it is wide.
Shape random_flat_solid(Random& random, Kind kind);
/// Closed and convex, twelve triangles.
Mesh cube_mesh(double half);

/// Uniform within a solid, on a flat shape.
glm::dvec3 random_point(Random& random, const Shape& shape);
/// On a corner, an edge or a rim; of a sphere anywhere on it.
glm::dvec3 random_end(Random& random, const Shape& shape);

}  // namespace lightbench::stress
