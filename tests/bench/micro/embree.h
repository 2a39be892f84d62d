#pragma once
// Embree over the same triangles or spheres and rays, if this build has it (LIGHTBENCH_EMBREE).

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "tests/bench/micro/kernel_loops.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace lightbench::micro {

/// Centre and radius.
using SphereNumbers = std::array<float, 4>;

/// A scene of one geometry, in render space. Its answers are as those of KernelLoops: `slot` is the
/// triangle or sphere.
class EmbreeScene {
 public:
  /// A mesh whose vertices are three floats each. `robust` is Embree's watertight mode; else its
  /// default flags.
  EmbreeScene(std::span<const std::array<float, 3>> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles, bool robust);
  /// Spheres, with default flags: tested by a function of ours (Embree's user geometry), or by
  /// Embree's own.
  enum class Spheres { User, BuiltIn };
  EmbreeScene(std::span<const SphereNumbers> spheres, Spheres tested);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void closest(const RaySet& rays, std::span<Answer> answers) const;
  void any(const RaySet& rays, std::span<Answer> answers) const;

 private:
  RTCDeviceTy* device_;
  RTCSceneTy* scene_;
  std::vector<SphereNumbers> spheres_;  ///< of user geometry
};

}  // namespace lightbench::micro
