#pragma once
// Scenes of a few objects, made for questions.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/query/rays.h"
#include "core/scene/scene.h"

namespace lightbench::stress {

/// A scene without objects: a tiny picture, one white material, the eye at 0.
Scene empty_scene();
/// Adds an object of material 0; a mesh is added to the scene with it.
Object& add_object(Scene& scene, const Shape& shape, const Transform& transform = {});
Object& add_mesh(Scene& scene, Mesh mesh, const Transform& transform = {});
/// One object, seen from `eye`: that is what the choice of precision goes by.
std::shared_ptr<const RenderScene> compile_alone(const Shape& shape, const glm::dvec3& eye,
                                                 KernelKind kernel);

std::vector<std::optional<Hit>> trace_all(const RenderScene& scene, std::span<const Ray> rays);

/// Half the distance to the next number after 1 in the kernel's type.
double rounding_of(const RenderScene& scene);

}  // namespace lightbench::stress
