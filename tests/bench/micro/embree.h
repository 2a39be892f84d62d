#pragma once
// Embree over the same triangles and rays, if this build has it (LIGHTBENCH_EMBREE).

#include <memory>
#include <span>

#include "tests/bench/micro/kernel_loops.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace lightbench::micro {

/// A scene of one mesh whose vertices are three floats each, in render space.
class EmbreeScene {
 public:
  /// `robust` is its watertight mode; else its default flags.
  EmbreeScene(std::span<const std::array<float, 3>> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles, bool robust);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// As KernelLoops: `slot` of an answer is the triangle.
  void closest(const RaySet& rays, std::span<Answer> answers) const;
  void any(const RaySet& rays, std::span<Answer> answers) const;

 private:
  RTCDeviceTy* device_;
  RTCSceneTy* scene_;
};

}  // namespace lightbench::micro
