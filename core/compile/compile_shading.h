#pragma once
// Materials, media, textures, lights, camera and environment for the kernel.

#include "core/compile/parts.h"

namespace lightbench {

template <class T>
std::shared_ptr<const MaterialPart<T>> compile_materials(const Scene& scene,
                                                         const GeometryPart<T>& geometry);

template <class T>
std::shared_ptr<const TexturePart<T>> compile_textures(const Scene& scene);

/// Emitters and the alias table that chooses among them by power.
template <class T>
std::shared_ptr<const LightPart<T>> compile_lights(const Scene& scene,
                                                   const GeometryPart<T>& geometry);

template <class T>
CameraView<T> compile_camera(const Scene& scene, const GeometryPart<T>& geometry, const Crop& crop);

template <class T>
EnvironmentView<T> compile_environment(const Environment& environment);

}  // namespace lightbench
