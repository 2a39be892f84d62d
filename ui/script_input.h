#pragma once
// Mouse and keyboard of a scripted interface: widgets are named "Window/Label" as in WidgetMap.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "ui/application.h"

namespace lightbench::ui {

/// {"click": NAME, "at": [fx, fy], "button": "left|right|middle", "with": "shift|ctrl", "times": 2}
/// at fractions of the widget (middle if not given). A panel behind others is brought to the front,
/// and scrolled to the widget. Throws Error{Usage} if there is no such widget.
void click_widget(Application& application, const nlohmann::json& step);
/// {"drag": NAME, "from": [fx, fy], "to": [fx, fy], "button": ..., "with": ...}
void drag_widget(Application& application, const nlohmann::json& step);
/// {"wheel": NAME, "turns": 2, "at": [fx, fy], "with": ...}
void turn_wheel(Application& application, const nlohmann::json& step);
/// Types into the field that has the focus.
void type_text(Application& application, const std::string& text);
/// "ctrl+shift+z", "f12", "delete", "enter", "]".
void press_key(Application& application, const std::string& keys);

}  // namespace lightbench::ui
