#pragma once
// The same world in other words, and how far two pictures of it are apart.

#include <glm/vec3.hpp>

#include "core/film/film.h"
#include "core/scene/scene.h"

namespace lightbench::proof {

/// `scene` in units `scale` times as fine, moved by `shift` (in the new units).
Scene in_other_units(Scene scene, double scale, const glm::dvec3& shift);

/// Turned about `axis` (any length but 0) through the origin.
Scene turned_world(Scene scene, const glm::dvec3& axis, double degrees);

/// Mirrored at the plane x = 0; its picture is the other one with left and right exchanged. Flat
/// one-sided lights turn their fronts round, so they must be two-sided.
Scene mirrored_world(Scene scene);

/// Of green: the ratio of the means, and the mean absolute difference over the mean of `a`.
struct PictureDifference {
  double mean_ratio, relative_mae;
};
PictureDifference picture_difference(const Film& a, const Film& b, int spp);

}  // namespace lightbench::proof
