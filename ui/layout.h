#pragma once
// Where the panels are docked: picture in the middle, lists on the left, properties on the right.

namespace lightbench::ui {

/// Covers the main window between menu and status bar with a dock space. The default layout is
/// built if there is none yet or `reset` asks for it; `scale` is pixels per layout unit.
void draw_dock_space(bool reset, float scale);

}  // namespace lightbench::ui
