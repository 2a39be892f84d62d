#pragma once
// What the benchmarks of traversal share: compiled meshes and rays in their render space, made
// once.

#include <memory>
#include <string>

#include "core/compile/parts.h"
#include "tests/bench/micro/embree.h"
#include "tests/bench/micro/rays.h"

namespace lightbench::micro {

/// A scene of one mesh.
struct Subject {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const RenderScene> scene;    ///< for the float kernels
  RaySet bounces, chords, segments;            ///< render space
  std::vector<std::array<float, 3>> vertices;  ///< render space

  [[nodiscard]] const KernelParts<float>& parts() const {
    return std::get<KernelParts<float>>(scene->parts->kernel);
  }
};

Scene scene_of(std::shared_ptr<const Mesh> mesh);

inline constexpr const char* kSubjects[] = {"sphere-70k", "sphere-300k", "hall-70k", "hall-300k"};

/// Made when first asked for.
const Subject& subject(std::size_t i);

}  // namespace lightbench::micro
