#include "ui/snapshots.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/film/image_file.h"

namespace lightbench::ui {
namespace {

constexpr int kThumbnailSize = 192;
constexpr std::size_t kMaxEntries = 64;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// The name itself if nothing is there, else name-2, name-3...
std::filesystem::path free_name(const std::filesystem::path& wanted,
                                const std::set<std::filesystem::path>& taken) {
  std::filesystem::path file = wanted;
  std::error_code error;
  for (int n = 2; std::filesystem::exists(file, error) || taken.count(file) != 0; ++n) {
    file = wanted;
    file.replace_filename(wanted.stem().string() + "-" + std::to_string(n) +
                          wanted.extension().string());
  }
  return file;
}

ImageMetadata metadata_of(const Frame& frame, const Scene& scene, const std::string& title) {
  return {{"Software", "Lightbench"},
          {"scene", title},
          {"samplesPerPixel", std::to_string(frame.spp)},
          {"renderTimeSeconds", std::to_string(frame.seconds)},
          {"seed", std::to_string(scene.render.seed)}};
}

}  // namespace

std::filesystem::path snapshot_path(const std::string& pattern, const std::string& title,
                                    std::uint32_t spp) {
  std::string name = pattern;
  replace_all(name, "{scene}", title);
  replace_all(name, "{spp}", std::to_string(spp));
  return name;
}

void SnapshotLog::keep(const std::shared_ptr<const Frame>& frame, const Scene& scene,
                       const std::string& title, bool replace, BackgroundJobs& jobs) {
  const std::filesystem::path wanted = snapshot_path(pattern, title, frame->spp);
  const auto earlier = replaceable_.find(wanted);
  const std::filesystem::path file =
      replace && earlier != replaceable_.end() ? earlier->second : free_name(wanted, taken_);
  taken_.insert(file);
  if (replace) replaceable_[wanted] = file;
  // The list shows files; one that is about to be replaced is no longer there.
  std::erase_if(entries_, [&](const auto& entry) { return entry->file == file && entry->written; });

  auto entry = std::make_unique<Snapshot>();
  entry->spp = frame->spp;
  entry->seconds = frame->seconds;
  entry->file = file;
  entries_.insert(entries_.begin(), std::move(entry));
  if (entries_.size() > kMaxEntries) entries_.pop_back();

  const Display display = scene.display;
  ImageMetadata metadata = metadata_of(*frame, scene, title);
  jobs.run(
      [this, frame, display, file, metadata = std::move(metadata)]() -> BackgroundJobs::Finish {
        SmallImage small = make_small(frame->image, display, kThumbnailSize);
        std::string problem;
        try {
          write_image(file, frame->image, display, metadata, frame->variance);
        } catch (const Error& error) {
          problem = error.what();
        }
        return [this, file, problem = std::move(problem), small = std::move(small)] {
          for (const auto& listed : entries_) {
            if (listed->file != file || listed->written) continue;
            listed->thumbnail = Thumbnail(small);
            listed->written = problem.empty();
            listed->error = problem;
          }
        };
      });
}

}  // namespace lightbench::ui
