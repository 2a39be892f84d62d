#pragma once
// The surfaces of shapes in world space, for the quadratures and polygon formulas of
// closed_forms.h. Fronts point outwards where the transform does not mirror.

#include <vector>

#include "app/proof/closed_forms.h"
#include "core/scene/scene.h"

namespace lightbench {

std::vector<glm::dvec3> place_all(const Transform& t, std::vector<glm::dvec3> points);

proof::EmittingPatch sphere_patch(const SphereShape& s, const Transform& t);
proof::EmittingPatch disc_patch(const glm::dvec3& center, const glm::dvec3& normal, double radius,
                                const Transform& t);
std::vector<proof::EmittingPatch> cylinder_patches(const CylinderShape& c, const Transform& t);

/// Counter-clockwise from outside.
std::vector<std::vector<glm::dvec3>> box_faces(const BoxShape& box, const Transform& t);
/// Counter-clockwise from outside, whatever the order of the vertices.
std::vector<std::vector<glm::dvec3>> pyramid_faces(const PyramidShape& p, const Transform& t);

}  // namespace lightbench
