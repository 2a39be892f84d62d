#pragma once
// The viewer in a window: waits for events, draws when something changed, sleeps otherwise.

#include <filesystem>

#include "core/scene/scene.h"
#include "ui/application.h"

namespace lightbench::ui {

/// Opens a window and returns when the user quits. Throws Error{Usage} if there is no display.
void run_window(Scene scene, const std::filesystem::path& file, const ApplicationOptions& options);

}  // namespace lightbench::ui
