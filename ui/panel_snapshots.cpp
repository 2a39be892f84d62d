#include <imgui.h>

#include <algorithm>
#include <array>

#include "core/format.h"
#include "ui/fields.h"
#include "ui/icons.h"
#include "ui/panels.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

constexpr std::array<const char*, 5> kExtensions{".png", ".exr", ".hdr", ".pfm", ".ppm"};

/// "10, 200, 1000" and back; what is not a positive number is left out.
std::string counts_to_text(const std::vector<int>& counts) {
  std::string text;
  for (const int count : counts) text += (text.empty() ? "" : ", ") + std::to_string(count);
  return text;
}

std::vector<int> counts_from_text(const std::string& text) {
  std::vector<int> counts;
  long number = 0;
  for (const char c : text + ",") {
    if (c >= '0' && c <= '9') {
      number = std::min(number * 10 + (c - '0'), 100'000'000L);
    } else {
      if (number > 0) counts.push_back(static_cast<int>(number));
      number = 0;
    }
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

void draw_format(std::string& pattern) {
  const std::string extension = std::filesystem::path(pattern).extension().string();
  const auto known = std::find(kExtensions.begin(), kExtensions.end(), extension);
  int index = static_cast<int>(known - kExtensions.begin());
  if (choice_field("Format", index, {"PNG", "EXR", "HDR", "PFM", "PPM"},
                   "PNG and PPM are tone mapped; EXR, HDR and PFM hold linear radiance")) {
    pattern = std::filesystem::path(pattern)
                  .replace_extension(kExtensions[static_cast<std::size_t>(index)])
                  .string();
  }
}

void draw_entry(const Snapshot& snapshot, float size) {
  const ImVec2 start = ImGui::GetCursorScreenPos();
  ImGui::Dummy({size, size});
  if (snapshot.thumbnail.texture() != 0) {
    const auto width = static_cast<float>(snapshot.thumbnail.width());
    const auto height = static_cast<float>(snapshot.thumbnail.height());
    const float scale = size / std::max(width, height);
    const ImVec2 min{start.x + 0.5F * (size - scale * width),
                     start.y + 0.5F * (size - scale * height)};
    ImGui::GetWindowDrawList()->AddImage(ImTextureRef(snapshot.thumbnail.texture()), min,
                                         {min.x + scale * width, min.y + scale * height});
  }
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::Text("%u spp", snapshot.spp);
  ImGui::SameLine();
  ImGui::TextColored(kPalette.muted, "%s", format_duration(snapshot.seconds).c_str());
  const std::string name = snapshot.file.filename().string();
  if (!snapshot.error.empty()) {
    ImGui::PushTextWrapPos();
    ImGui::TextColored(kPalette.error, "%s", snapshot.error.c_str());
    ImGui::PopTextWrapPos();
  } else {
    ImGui::PushStyleColor(ImGuiCol_Text, kPalette.muted);
    elided_text(snapshot.written ? name : "writing...");
    ImGui::PopStyleColor();
  }
  ImGui::EndGroup();
  note_widget(name.c_str());
  ImGui::SetItemTooltip("%s", snapshot.file.string().c_str());
}

}  // namespace

void draw_snapshots_panel(Workbench& bench) {
  if (ImGui::Begin(panel::kSnapshots)) {
    RenderSettings& render = bench.editor.scene.render;
    std::string counts = counts_to_text(render.snapshots);
    if (text_field("At spp", counts, "10, 200, 1000")) render.snapshots = counts_from_text(counts);
    draw_format(bench.snapshots.pattern);
    std::string pattern = bench.snapshots.pattern;
    if (wide_text_field("File", pattern) && !pattern.empty()) bench.snapshots.pattern = pattern;
    tip_for_last("Where snapshots go; {scene} and {spp} are filled in");
    toggle_field("Automatic", bench.snapshots.automatic, "Write the counts above when reached");
    ImGui::BeginDisabled(bench.frame == nullptr);
    if (ImGui::Button((std::string(icon::kCamera) + "  Snapshot now###now").c_str(),
                      {-FLT_MIN, 0})) {
      bench.request(Action::SnapshotNow);
    }
    ImGui::EndDisabled();
    note_widget("Snapshot now");
    tip_for_last(shortcut_keys(Action::SnapshotNow));
    ImGui::Spacing();
    const float size = 3.2F * ImGui::GetFontSize();
    for (const auto& snapshot : bench.snapshots.entries()) draw_entry(*snapshot, size);
    if (bench.snapshots.entries().empty()) note("None yet.");
  }
  ImGui::End();
}

}  // namespace lightbench::ui
