#pragma once
// Textbook ray-shape intersection in long double and object space, to judge the renderer's by. It
// shares nothing with core/shapes but the definition of each shape.

#include <glm/vec3.hpp>
#include <optional>

#include "core/scene/scene.h"

namespace lightbench {

struct OracleHit {
  double t;
  glm::dvec3 p, n;  ///< n is unit and outward
  double u = 0, v = 0;
  bool has_u = true, has_v = true;  ///< false where the convention leaves it open
};

/// First hit with t > 0 of the ray o + t d (object space) with the shape at `time`.
std::optional<OracleHit> oracle_hit(const Shape& shape, const Mesh& mesh, const glm::dvec3& o,
                                    const glm::dvec3& d, double time);

}  // namespace lightbench
