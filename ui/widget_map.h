#pragma once
// Where each widget was drawn, by name: what scripts and tests click on.

#include <imgui.h>

#include <map>
#include <string>

namespace lightbench::ui {

/// Rectangles in screen coordinates of the last frame, keyed "Window/Label", and "Tab/Window"
/// for the tabs of docked panels. A Gui owns one and
/// hands it to the widgets through ImGui's user data, so that panels need not pass it on.
struct WidgetMap {
  struct Place {
    ImVec2 min, max;
    bool visible = false;  ///< false when scrolled out of sight
  };
  std::map<std::string, Place> places;
};

/// Records the widget drawn last under the title of its window. Call right after the widget.
void note_widget(const char* label);

}  // namespace lightbench::ui
