#pragma once
// What a headless render says when it ends: a summary for people, a JSON file for programs.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/session/session.h"

namespace lightbench {

struct SavedPicture {
  std::filesystem::path file;
  std::uint32_t spp = 0;
  double seconds = 0;  ///< render time when the count was reached
};

struct RenderReport {
  std::string scene_file;
  std::string kernel;
  std::string stopped_by;   ///< target, time limit, SIGINT or SIGTERM
  double wall_seconds = 0;  ///< from reading the scene to the last file
  SessionStatus status;
  std::string replay;  ///< command that prints the path of the first dropped sample
  std::vector<SavedPicture> pictures;
};

/// A few lines for the end of the output.
std::string summary(const RenderReport& report);

/// The document of --stats-json (docs/command-line.md lists its keys).
std::string stats_json(const RenderReport& report, const Scene& scene);

/// Peak resident memory of this process.
std::int64_t peak_memory_bytes();

}  // namespace lightbench
