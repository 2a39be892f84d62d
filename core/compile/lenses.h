#pragma once
// The spheres of clear glass through which lights are sampled (core/lights/lens.h).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/compile/glass_interior.h"
#include "core/compile/light_place.h"
#include "core/compile/parts.h"
#include "core/scene/scene.h"

namespace lightbench {

/// In render space.
struct GlassSphere {
  glm::dvec3 center, motion;
  double radius, ior;
  std::uint32_t primitive;
  glm::dvec3 tint;  ///< of both refractions together
  bool crowded;     ///< something may reach into it
  /// Center at half the shutter.
  [[nodiscard]] glm::dvec3 middle() const { return center + 0.5 * motion; }
};

/// The scene's first kMaxWithImages, more cannot be used, but for hollow ones.
template <class T>
std::vector<GlassSphere> glass_spheres(const Scene& scene, const GeometryPart<T>& geometry,
                                       const ObjectBoxes& boxes);

/// Whether the lamp keeps clear of the sphere, so that the one is seen through the other.
bool can_light(const Lamp& lamp, const GlassSphere& sphere);

/// The part of the images' equation that depends on the lamp's place, at each node.
std::array<double, kLensNodes> lens_turns(const Lamp& lamp, const GlassSphere& sphere);

/// What the lamp brings to a point straight below the sphere, in the measure of contribution()
/// (core/lights/light_choice.h), by the point's distance and the angle at which the lamp stands off
/// the axis; kLensCells numbers.
std::vector<double> lens_table(const Lamp& lamp, const GlassSphere& sphere);

template <class T>
void append_lens(const GlassSphere& sphere, T offset, std::vector<T>& rows);

}  // namespace lightbench
