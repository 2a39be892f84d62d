#pragma once
// What the tests of queries ask with: random numbers, the kernels of this machine, stored scenes.

#include <cmath>
#include <filesystem>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/query/rays.h"
#include "core/scene/scene_io.h"

namespace lightbench {

class Random {
 public:
  double unit() { return uniform_(engine_); }
  double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
  glm::dvec3 direction() {
    const double z = between(-1, 1), a = between(0, 6.283185307179586);
    return {std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z};
  }

 private:
  std::mt19937_64 engine_{7};
  std::uniform_real_distribution<double> uniform_;
};

inline std::vector<KernelKind> kernels() {
  std::vector<KernelKind> found;
  for (const KernelKind kind :
       {KernelKind::Scalar, KernelKind::Avx2, KernelKind::Avx512, KernelKind::Reference}) {
    if (kernel_supported(kind)) found.push_back(kind);
  }
  return found;
}

inline Scene stored_scene(const char* name) {
  return load_scene(std::filesystem::path(LIGHTBENCH_SOURCE_DIR) / "scenes" / name);
}

/// Rays through the picture and a bit beyond, 1.7 long.
inline std::vector<Ray> picture_rays(const Scene& scene, int count) {
  Random random;
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    rays.push_back(camera_ray(scene, random.between(-0.2, 1.2) * scene.render.width,
                              random.between(-0.2, 1.2) * scene.render.height));
    rays.back().direction *= 1.7;
    rays.back().time = random.between(scene.camera.shutter_open, scene.camera.shutter_close);
  }
  return rays;
}

}  // namespace lightbench
