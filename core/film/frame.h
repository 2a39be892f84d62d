#pragma once
// A published picture: an immutable copy of the film after a whole pass.

#include <cstdint>
#include <memory>
#include <vector>

#include "core/scene/image.h"

namespace lightbench {

struct RenderScene;

/// `image` holds mean linear radiance per pixel of the crop window (or of the whole picture). With
/// `divider` d > 1 it is a look: one pixel stands for d x d.
struct Frame {
  Image image;
  std::vector<float> variance;  ///< of one sample's luminance, per pixel; empty unless asked for
  int divider = 1;
  std::uint32_t spp = 0;
  double seconds = 0;                        ///< render time of this generation, pauses excluded
  std::uint64_t generation = 0;              ///< which submit() it belongs to
  std::uint64_t serial = 0;                  ///< grows with each published frame
  std::shared_ptr<const RenderScene> scene;  ///< what was traced, for picking
};

}  // namespace lightbench
