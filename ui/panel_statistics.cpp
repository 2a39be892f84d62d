#include <imgui.h>

#include "core/format.h"
#include "core/query/replay.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lightbench::ui {
namespace {

std::string target_of(const SessionStatus& status) {
  return status.target_spp == 0 ? "no limit" : format_integer(status.target_spp) + " spp";
}

/// Samples that the film could not take, by cause, and the way to see the first of them.
void draw_dropped(const Workbench& bench) {
  const Counters& counters = bench.status.counters;
  value_row("Non-finite", format_integer(static_cast<std::int64_t>(counters.non_finite)));
  if (counters.non_finite == 0) return;
  for (int k = 0; k < kFaults; ++k) {
    if (counters.faults[k] == 0) continue;
    ImGui::TextColored(kPalette.error, "%s dropped: %s",
                       format_integer(static_cast<std::int64_t>(counters.faults[k])).c_str(),
                       fault_name(static_cast<Fault>(k)));
  }
  ImGui::TextColored(kPalette.error, "first at pixel %d, %d sample %u: %s", counters.bad.x,
                     counters.bad.y, counters.bad.sample, fault_name(counters.bad_fault));
  ImGui::BeginDisabled(bench.editor.file().empty());
  if (ImGui::Button("Copy replay command")) {
    ImGui::SetClipboardText(replay_command(bench.editor.file().string(), bench.editor.scene.render,
                                           kernel_name(bench.status.scene.kernel), counters.bad)
                                .c_str());
  }
  ImGui::EndDisabled();
  tip_for_last("A command line that prints the path of that sample, of the scene as saved");
}

/// Median and slow end.
void draw_timings(const char* label, const Timings& timings, const char* tip) {
  const bool known = timings.count() > 0;
  value_row(label, known ? format_duration(timings.quantile(0.5)) + " / " +
                               format_duration(timings.quantile(0.99))
                         : "-");
  tip_for_last(tip);
}

}  // namespace

void draw_statistics_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kStatistics)) {
    const SessionStatus& status = bench.status;
    if (section("Progress")) {
      value_row("Samples", format_integer(status.spp) + " spp");
      if (bench.editor.scene.render.adaptive) {
        value_row("Of a pixel", format_integer(status.samples.least) + " to " +
                                    format_integer(status.samples.most));
        tip_for_last("Least and most samples of any pixel; the line above is their average");
      }
      value_row("Target", target_of(status));
      value_row("Elapsed", format_duration(status.seconds));
      const bool running = status.state == SessionState::Rendering;
      value_row("Remaining", running ? format_duration(status.remaining) : "-");
    }
    if (section("Speed")) {
      value_row("Paths", format_count(status.samples_per_second, "/s"));
      value_row("Rays", format_count(status.rays_per_second, "/s"));
      value_row("Threads", std::to_string(status.threads));
      draw_dropped(bench);
    }
    if (section("Scene")) {
      value_row("Objects", format_integer(status.scene.objects));
      value_row("Primitives", format_integer(status.scene.primitives));
      value_row("Triangles", format_integer(status.scene.triangles));
      value_row("Lights", format_integer(status.scene.lights));
      value_row("Memory", format_bytes(static_cast<std::uint64_t>(status.scene.bytes)));
      value_row("Film", format_bytes(status.film_bytes));
      value_row("Compiled in", format_duration(status.scene.compile_seconds));
    }
    if (section("Interface")) {
      draw_timings("Frame", bench.frame_times, "Time to draw the interface once: median / 99 %");
      draw_timings("Edit", bench.edit_times,
                   "From an edit to the first picture of it: median / 99 %");
    }
    if (section("Features")) {
      for (const FeatureUse& feature : status.scene.features) {
        value_row(feature.name.c_str(), feature.used ? "used" : "skipped");
        tip_for_last(feature.note.empty() ? nullptr : feature.note.c_str());
      }
    }
  }
  ImGui::End();
}

}  // namespace lightbench::ui
