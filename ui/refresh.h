#pragma once
// How often the screen shows a settling picture: at once after an edit, then ever more slowly, and
// never so often that drawing takes more than its share of the processor.

#include <cstdint>

namespace lightbench::ui {

/// Share of one core that drawing may take while the renderer works.
inline constexpr double kDisplayShare = 0.1;

/// Seconds between two redraws for a picture of `spp` samples that started `age` seconds ago, when
/// drawing one frame takes `frame_seconds`: 0.1 s at first, 2 s in the end (as in Cycles), and at
/// least frame_seconds / kDisplayShare.
double refresh_interval(std::uint32_t spp, double age, double frame_seconds);

}  // namespace lightbench::ui
