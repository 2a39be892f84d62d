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
  if (counters.non_finite == 0) return text + "no non-finite samples\n";
  std::string causes;
  for (int k = 0; k < kFaults; ++k) {
    if (counters.faults[k] == 0) continue;
    causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", counters.faults[k],
                          fault_name(static_cast<Fault>(k)));
  }
  return text + fmt::format(
                    "{} samples dropped ({}), the first ({}) at pixel {},{} sample {}; to see it:\n"
                    "{}\n",
                    counters.non_finite, causes, fault_name(counters.bad_fault), counters.bad.x,
                    counters.bad.y, counters.bad.sample, report.replay);
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
      {"leastSamples", status.samples.least},
      {"mostSamples", status.samples.most},
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
    const auto count = [&](Fault fault) { return counters.faults[static_cast<int>(fault)]; };
    json["nonFiniteCauses"] = {{"nan", count(Fault::NotANumber)},
                               {"infinite", count(Fault::Infinite)},
                               {"negative", count(Fault::Negative)},
                               {"beyondFilm", count(Fault::BeyondFilm)}};
    json["firstNonFinite"] = {{"pixel", {counters.bad.x, counters.bad.y}},
                              {"sample", counters.bad.sample},
                              {"cause", fault_name(counters.bad_fault)},
                              {"replay", report.replay}};
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
