#include "app/render_report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "app/version.h"
#include "core/format.h"

namespace lightbench {

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

std::string summary(const RenderReport& report) {
  const SessionStatus& status = report.status;
  std::string text = fmt::format(
      "{} spp in {} on {} thread{}, kernel {} (stopped by {})\n"
      "{}, {}, compiled in {:.1f} ms, peak memory {}\n",
      status.spp, format_duration(status.seconds), status.threads, status.threads == 1 ? "" : "s",
      report.kernel, report.stopped_by, format_count(status.samples_per_second, "samples/s"),
      format_count(status.rays_per_second, "rays/s"), 1000 * status.scene.compile_seconds,
      format_bytes(static_cast<std::uint64_t>(peak_memory_bytes())));
  const Counters& counters = status.counters;
  if (counters.non_finite == 0) {
    text += "no non-finite samples\n";
  } else {
    text += fmt::format("{} non-finite samples dropped, the first at pixel {},{} sample {}\n",
                        counters.non_finite, counters.bad_x, counters.bad_y, counters.bad_sample);
  }
  return text;
}

std::string stats_json(const RenderReport& report, const Scene& scene) {
  const SessionStatus& status = report.status;
  const RenderSettings& render = scene.render;
  const Counters& counters = status.counters;
  nlohmann::ordered_json json = {
      {"lightbench", version_number()},
      {"scene", report.scene_file},
      {"resolution", {render.width, render.height}},
      {"seed", render.seed},
      {"kernel", report.kernel},
      {"threads", status.threads},
      {"stoppedBy", report.stopped_by},
      {"spp", status.spp},
      {"targetSpp", status.target_spp},
      {"renderSeconds", status.seconds},
      {"wallSeconds", report.wall_seconds},
      {"compileSeconds", status.scene.compile_seconds},
      {"samples", counters.paths},
      {"rays", counters.rays},
      {"shadowRays", counters.shadow_rays},
      {"samplesPerSecond", status.samples_per_second},
      {"raysPerSecond", status.rays_per_second},
      {"nonFiniteSamples", counters.non_finite},
      {"peakMemoryBytes", peak_memory_bytes()},
      {"filmBytes", status.film_bytes},
      {"sceneBytes", status.scene.bytes},
  };
  if (counters.non_finite > 0) {
    json["firstNonFinite"] = {{"pixel", {counters.bad_x, counters.bad_y}},
                              {"sample", counters.bad_sample}};
  }
  if (render.crop.width > 0) {
    json["crop"] = {render.crop.x, render.crop.y, render.crop.width, render.crop.height};
  }
  json["pictures"] = nlohmann::ordered_json::array();
  for (const SavedPicture& picture : report.pictures) {
    json["pictures"].push_back({{"file", picture.file.string()},
                                {"spp", picture.spp},
                                {"renderSeconds", picture.seconds}});
  }
  return json.dump(2) + "\n";
}

}  // namespace lightbench
