#pragma once
// A list of scene items as the left-hand panels show them: icon, name, selection, right-click menu.

#include <imgui.h>

#include "ui/workbench.h"

namespace lightbench::ui {

/// One row; draws at the cursor and selects on a click. `swatch`, if given, is a colour square in
/// place of the icon; `trailing` is the width kept free at the end of the row.
void draw_item_row(Workbench& bench, Selection item, const char* icon, const ImVec4* swatch,
                   bool dimmed, float trailing);

/// The "+" menus; each selects what it adds.
void add_object_menu(Workbench& bench);
void add_material_menu(Workbench& bench);
void add_texture_menu(Workbench& bench);
void add_light(Workbench& bench);
void add_medium(Workbench& bench);

/// Title of a list with an add button at its end; true when clicked.
bool list_header(const char* title, int count, const char* add_label);

}  // namespace lightbench::ui
