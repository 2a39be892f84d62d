#pragma once
// How the interface looks: neutral greys, so that nothing around the picture biases the judgement
// of its colours, and one accent.

#include <imgui.h>

namespace lightbench::ui {

/// The accent and the few colours that panels draw with themselves (sRGB).
struct Palette {
  ImVec4 accent{0.91F, 0.64F, 0.24F, 1};
  ImVec4 text{0.88F, 0.88F, 0.88F, 1};
  ImVec4 muted{0.58F, 0.58F, 0.58F, 1};
  ImVec4 error{0.93F, 0.42F, 0.36F, 1};
  ImVec4 surround{0.085F, 0.085F, 0.085F, 1};  ///< around the picture
};
inline constexpr Palette kPalette;

/// Text height in layout units.
inline constexpr float kFontSize = 16;

/// Loads Inter and the icons into the current ImGui context.
void load_fonts();

/// Sets colours and sizes of the current ImGui context for `scale` pixels per layout unit.
void apply_theme(float scale);

}  // namespace lightbench::ui
