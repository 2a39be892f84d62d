#pragma once
// What points choose between by contribution (core/lights/light_choice.h): the lights of a scene
// that has few, and their images in its plane mirrors.

#include "core/compile/parts.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Fills the candidates of `lights`, whose lights are known; none where the choice by power is as
/// good (one light and no mirror) or too many would have to be judged at every vertex.
template <class T>
void add_light_candidates(const Scene& scene, const GeometryPart<T>& geometry,
                          LightPart<T>& lights);

}  // namespace lightbench
