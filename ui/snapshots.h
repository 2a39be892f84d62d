#pragma once
// Pictures kept at chosen sample counts: written while the render goes on, and listed.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/film/frame.h"
#include "core/scene/scene.h"
#include "ui/background_jobs.h"
#include "ui/thumbnail.h"

namespace lightbench::ui {

struct Snapshot {
  std::uint32_t spp = 0;
  double seconds = 0;  ///< render time
  std::filesystem::path file;
  bool written = false;
  std::string error;  ///< why it could not be written
  Thumbnail thumbnail;
};

/// `pattern` with {scene} and {spp} replaced.
std::filesystem::path snapshot_path(const std::string& pattern, const std::string& title,
                                    std::uint32_t spp);

/// UI thread only; files are written by `jobs`, which must be destroyed before the log.
class SnapshotLog {
 public:
  /// Where files go; the extension decides the format.
  std::string pattern = "out/{scene}-{spp}spp.png";
  /// Whether the counts in RenderSettings::snapshots are written when reached.
  bool automatic = true;

  /// Writes the picture, under a number if its name is taken. With `replace` it takes the place of
  /// the picture that this log kept under the same name with `replace`, and of no other file.
  void keep(const std::shared_ptr<const Frame>& frame, const Scene& scene, const std::string& title,
            bool replace, BackgroundJobs& jobs);

  /// Newest first.
  [[nodiscard]] const std::vector<std::unique_ptr<Snapshot>>& entries() const { return entries_; }

 private:
  std::vector<std::unique_ptr<Snapshot>> entries_;
  std::set<std::filesystem::path> taken_;                               ///< perhaps not written yet
  std::map<std::filesystem::path, std::filesystem::path> replaceable_;  ///< file by wanted name
};

}  // namespace lightbench::ui
