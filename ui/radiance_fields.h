#pragma once
// Light of any brightness as a colour that a screen can show and a strength.

#include <glm/vec3.hpp>

namespace lightbench::ui {

/// Rows for radiance = color * strength, both >= 0. A colour beyond 1 is shown scaled to 1 with the
/// factor in the strength; the pair is only rewritten when the user edits it.
bool radiance_fields(const char* label, glm::dvec3& color, double& strength);

}  // namespace lightbench::ui
