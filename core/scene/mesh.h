#pragma once
// A triangle mesh as data; how rays meet it is the business of core/accel and core/kernel.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace lightbench {

/// Positions are in object space (scene units). `normals` (shading normals, unit) and `uvs` are
/// either empty or have one entry per position. A triangle is three indices into `positions`,
/// counter-clockwise seen from its front.
struct Mesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec3> normals;
  std::vector<glm::dvec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  bool operator==(const Mesh&) const = default;
};

}  // namespace lightbench
