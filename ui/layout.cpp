#include "ui/layout.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>

#include "ui/panels.h"

namespace lightbench::ui {
namespace {

void build_default(ImGuiID root, float scale) {
  const ImVec2 size = ImGui::GetMainViewport()->WorkSize;
  ImGui::DockBuilderRemoveNode(root);
  ImGui::DockBuilderAddNode(root, ImGuiDockNodeFlags_DockSpace);
  ImGui::DockBuilderSetNodeSize(root, size);
  // Side columns grow a little with the window; the picture gets the rest.
  const float left_width = std::clamp(0.16F * size.x, 220 * scale, 300 * scale);
  const float right_width = std::clamp(0.22F * size.x, 310 * scale, 380 * scale);
  ImGuiID center = root;
  const ImGuiID left =
      ImGui::DockBuilderSplitNode(center, ImGuiDir_Left, left_width / size.x, nullptr, &center);
  const ImGuiID right = ImGui::DockBuilderSplitNode(
      center, ImGuiDir_Right, right_width / (size.x - left_width), nullptr, &center);
  ImGuiID left_top = left;
  const ImGuiID left_bottom =
      ImGui::DockBuilderSplitNode(left_top, ImGuiDir_Down, 0.42F, nullptr, &left_top);
  for (const char* title : {panel::kScene, panel::kLights, panel::kMaterials}) {
    ImGui::DockBuilderDockWindow(title, left_top);
  }
  for (const char* title : {panel::kSnapshots, panel::kStatistics}) {
    ImGui::DockBuilderDockWindow(title, left_bottom);
  }
  for (const char* title :
       {panel::kProperties, panel::kCamera, panel::kEnvironment, panel::kRender}) {
    ImGui::DockBuilderDockWindow(title, right);
  }
  ImGui::DockBuilderDockWindow(panel::kPicture, center);
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
