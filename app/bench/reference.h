#pragma once
// The picture that errors are measured against, with what it was made of.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "core/scene/image.h"
#include "core/scene/scene.h"

namespace lightbench::bench {

/// Stored as an EXR file whose header holds the rest.
struct Reference {
  Image image;
  std::uint64_t hash = 0;  ///< picture_hash of the scene
  std::uint32_t spp = 0;   ///< in all
  /// Expected error of the reference itself, from the spread of its independent parts.
  double mse = 0, relmse = 0;
};

/// `folder`/NAME.exr for a scene file NAME.json.
std::filesystem::path reference_file(const std::filesystem::path& folder,
                                     const std::filesystem::path& scene_file);

/// Throws Error{Scene} if it cannot be read, is none, or was made for another picture.
Reference load_reference(const std::filesystem::path& file, const Scene& scene,
                         const std::filesystem::path& scene_file);

struct ReferenceGoal {
  double relmse = 1e-4;   ///< ends when the reference's own error is below ...
  double seconds = 3600;  ///< ... or after so long
  int threads = 1;
};
/// Share of the way to the goal (0..1) and the error so far.
using ReferenceProgress = std::function<void(double share, double relmse, double seconds)>;

/// Averages independent renders of 256 samples per pixel by a double precision kernel, at least
/// eight.
Reference make_reference(const Scene& scene, const ReferenceGoal& goal,
                         const ReferenceProgress& progress);

void save_reference(const std::filesystem::path& file, const Reference& reference,
                    const std::filesystem::path& scene_file);

}  // namespace lightbench::bench
