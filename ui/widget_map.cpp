#include "ui/widget_map.h"

#include <imgui_internal.h>

namespace lightbench::ui {

void note_widget(const char* label) {
  auto* map = static_cast<WidgetMap*>(ImGui::GetIO().UserData);
  if (map == nullptr) return;
  const ImGuiWindow* window = ImGui::GetCurrentWindow();
  // Children and popups carry generated names; the name a person knows is that of the outermost
  // one.
  const std::string title = (window->Flags & ImGuiWindowFlags_Popup) != 0
                                ? std::string("Popup")
                                : std::string(window->RootWindow->Name);
  map->places[title.substr(0, title.find("##")) + "/" + label] = {
      ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), ImGui::IsItemVisible()};
}

}  // namespace lightbench::ui
