#pragma once
// One function per panel, one panel per file. Each draws an ImGui window (or a bar) and edits the
// workbench; none of them talks to the renderer.

#include "ui/workbench.h"

namespace lightbench::ui {

/// Titles of the dockable panels, as the layout and the tests name them.
namespace panel {
inline constexpr const char* kPicture = "Picture";
inline constexpr const char* kScene = "Scene";
inline constexpr const char* kLights = "Lights";
inline constexpr const char* kMaterials = "Materials";
inline constexpr const char* kProperties = "Properties";
inline constexpr const char* kCamera = "Camera";
inline constexpr const char* kEnvironment = "Environment";
inline constexpr const char* kRender = "Render";
inline constexpr const char* kSnapshots = "Snapshots";
inline constexpr const char* kStatistics = "Statistics";
}  // namespace panel

void draw_picture_panel(Workbench& bench);     // viewport, toolbar, mouse in the picture
void draw_scene_panel(Workbench& bench);       // list of objects
void draw_lights_panel(Workbench& bench);      // objects that emit
void draw_materials_panel(Workbench& bench);   // materials, textures, media
void draw_properties_panel(Workbench& bench);  // every parameter of the selection
void draw_camera_panel(Workbench& bench);
void draw_environment_panel(Workbench& bench);
void draw_render_panel(Workbench& bench);
void draw_snapshots_panel(Workbench& bench);
void draw_statistics_panel(Workbench& bench);

void draw_menu_bar(Workbench& bench);
void draw_status_bar(Workbench& bench);
void draw_help(Workbench& bench);
/// "Save changes?" while Workbench::unsaved_asked.
void draw_unsaved_question(Workbench& bench);

}  // namespace lightbench::ui
