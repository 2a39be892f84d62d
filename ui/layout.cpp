#include "ui/layout.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <initializer_list>

#include "ui/panels.h"

namespace lightbench::ui {
namespace {

constexpr float kNarrow = 900;  // layout units below which lists and properties share a column

void dock(ImGuiID node, std::initializer_list<const char*> titles) {
  for (const char* title : titles) ImGui::DockBuilderDockWindow(title, node);
}

void build_default(ImGuiID root, float scale) {
  const ImVec2 size = ImGui::GetMainViewport()->WorkSize;
  ImGui::DockBuilderRemoveNode(root);
  ImGui::DockBuilderAddNode(root, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(root, size);
  ImGuiID center = root;
  ImGuiID lists = 0;
  ImGuiID properties = 0;
  ImGuiID results = 0;
  if (size.x < kNarrow * scale) {
    lists = ImGui::DockBuilderSplitNode(center, ImGuiDir_Right, 0.46F, nullptr, &center);
    properties = ImGui::DockBuilderSplitNode(lists, ImGuiDir_Down, 0.6F, nullptr, &lists);
    results = lists;
  } else {
    // Side columns grow a little with the window; the picture gets the rest.
    const float left = std::clamp(0.16F * size.x, 236 * scale, 300 * scale);
    const float right = std::clamp(0.22F * size.x, 334 * scale, 390 * scale);
    lists = ImGui::DockBuilderSplitNode(center, ImGuiDir_Left, left / size.x, nullptr, &center);
    properties = ImGui::DockBuilderSplitNode(center, ImGuiDir_Right, right / (size.x - left),
                                             nullptr, &center);
    results = ImGui::DockBuilderSplitNode(lists, ImGuiDir_Down, 0.36F, nullptr, &lists);
  }
  dock(lists, {panel::kScene, panel::kLights, panel::kMaterials});
  dock(results, {panel::kSnapshots, panel::kStatistics});
  dock(properties, {panel::kProperties, panel::kCamera, panel::kEnvironment, panel::kRender});
  dock(center, {panel::kPicture});
  if (ImGuiDockNode* node = ImGui::DockBuilderGetNode(center)) {
    node->SetLocalFlags(ImGuiDockNodeFlags_NoTabBar | ImGuiDockNodeFlags_CentralNode |
                        ImGuiDockNodeFlags_NoUndocking);
  }
  ImGui::DockBuilderFinish(root);
}

}  // namespace

void draw_dock_space(bool reset, float scale) {
  const ImGuiID root = ImGui::GetID("lightbench");
  if (reset || ImGui::DockBuilderGetNode(root) == nullptr) build_default(root, scale);
  ImGui::DockSpaceOverViewport(
      root, ImGui::GetMainViewport(),
      ImGuiDockNodeFlags_NoWindowMenuButton | ImGuiDockNodeFlags_NoCloseButton);
}

}  // namespace lightbench::ui
