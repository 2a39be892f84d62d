#pragma once
// The bar above the picture: pause, restart, snapshot, exposure, tone map, zoom.

#include "ui/workbench.h"

namespace lightbench::ui {

/// Draws into the current ImGui window.
void draw_toolbar(Workbench& bench);

}  // namespace lightbench::ui
