#pragma once
// What points choose between by contribution (core/lights/light_choice.h): the lights of a scene
// that has few, and their images in its plane mirrors and through its glass boxes and spheres.

#include "core/compile/light_place.h"
#include "core/compile/parts.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Fills the candidates of `lights`, kMaxLightCandidates at most; none where there is nothing to
/// choose (one light, no mirror and no glass).
template <class T>
void add_light_candidates(const Scene& scene, const GeometryPart<T>& geometry,
                          const std::vector<Lamp>& lamps, LightPart<T>& lights);

}  // namespace lightbench
