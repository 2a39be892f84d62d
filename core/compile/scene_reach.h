#pragma once
// How far a scene reaches and how fine it is: the render space that suits it, and the number type.
// Float positions in render space are good to 2^-24 of the farthest coordinate; where that is
// coarse against the smallest feature, double lanes trace.

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/compile/render_space.h"
#include "core/scene/scene.h"

namespace lightbench {

/// The largest range for which float lanes are chosen. Positions are then good to a thousandth of
/// the smallest feature: 2^-24 * 2^14 = 2^-10.
inline constexpr double kFloatRange = 16384;

/// Up to this range float decides hit or miss of a sphere wrongly less than once in a million rays
/// without refining its closest approach (HitQuality).
inline constexpr double kPlainRange = 64;

struct SceneReach {
  glm::dvec3 center{0};                        ///< of render space
  double shutter_open = 0, shutter_close = 1;  ///< what moves was measured between these times
  std::vector<std::uint8_t> roles;             ///< of each object, see object_roles()
  double farthest = 0;                         ///< largest coordinate of a surface, from the center
  /// The smallest radius, height, thickness or altitude of any object; infinite without objects. Of
  /// a mesh the longest side of its smallest piece (mesh_pieces.h): triangles of one piece share
  /// their vertices, which a step of float moves together.
  double smallest = 0;
  std::string smallest_object;  ///< its name
  /// The smallest gap between surfaces that lie over each other (surface_gaps.h), if float could
  /// lose it to some eye; else infinite.
  double gap = std::numeric_limits<double>::infinity();
  std::array<std::string, 2> gap_between;
  /// smallest_piece() of the scene's meshes; not asked again while a mesh is the same.
  std::vector<std::pair<std::shared_ptr<const Mesh>, double>> pieces;
};

/// What each object is to the geometry: bit 0 surface, bit 1 boundary of a medium.
std::vector<std::uint8_t> object_roles(const Scene& scene);

/// What `previous` knows of meshes that are still there is taken over.
SceneReach measure_reach(const Scene& scene, const SceneReach* previous = nullptr);

/// The farthest surface or camera position over the smallest feature; 1 without objects.
double range_of(const SceneReach& reach, const Camera& camera);

/// Double where the range is beyond kFloatRange or a gap is lost to float, from this eye.
Precision needed_precision(const SceneReach& reach, const Camera& camera);
/// Why, for people.
std::string precision_reason(const SceneReach& reach, const Camera& camera);

}  // namespace lightbench
