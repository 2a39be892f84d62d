#pragma once
// Image textures in the editor: asking for a file, loading it off the UI thread.

#include <string>

#include "ui/workbench.h"

namespace lightbench::ui {

/// Loads `file` (as the scene names it) and makes it the image of the texture called `texture`, or
/// of a new texture if that name is empty. The scene changes when the image has arrived.
void load_texture_image(Workbench& bench, const std::string& texture, const std::string& file,
                        bool srgb);
/// The same after asking for the file.
void ask_for_texture_image(Workbench& bench, const std::string& texture);

}  // namespace lightbench::ui
