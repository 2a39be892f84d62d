#pragma once
// Names the picture that a scene converges to.

#include <cstdint>

#include "core/scene/scene.h"

namespace lightbench {

/// Equal for scenes whose renders have the same expected values, pixel by pixel: a hash of all that
/// decides them (with the pixels of images and the data of meshes), but not of how they are
/// estimated (seed, sample counts, time, roulette) or shown (exposure, tone map). FNV-1a, 64 bits.
std::uint64_t picture_hash(const Scene& scene);

}  // namespace lightbench
