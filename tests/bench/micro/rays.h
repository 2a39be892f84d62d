#pragma once
// Rays to measure with: incoherent ones, in random order, the same for every run.

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/mesh.h"

namespace lightbench::micro {

/// In one array per number; padded to a multiple of 16 with copies of the first ray. Directions are
/// unit; t_max is infinite for rays that ask for the closest hit.
struct RaySet {
  std::size_t size = 0;  ///< without the padding
  std::array<std::vector<float>, 3> o, d;
  std::vector<float> t_max;
  [[nodiscard]] std::size_t padded() const { return t_max.size(); }
};

/// Rays that leave random points of the mesh, from the front, by the cosine about its normal: the
/// bounces of a path tracer.
RaySet bounces(const Mesh& mesh, std::size_t count);

/// Random chords of the sphere around the mesh.
RaySet chords(const Mesh& mesh, std::size_t count);

/// Random chords of the sphere around 0.
RaySet chords_of_ball(double radius, std::size_t count);

/// From random points of the mesh to random points of its bounding box: shadow rays.
RaySet segments(const Mesh& mesh, std::size_t count);

}  // namespace lightbench::micro
