#include "ui/script_input.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "ui/script.h"

namespace lightbench::ui {
namespace {

using nlohmann::json;

int button_of(const json& step) {
  const std::string name = step.value("button", "left");
  if (name == "left") return ImGuiMouseButton_Left;
  if (name == "right") return ImGuiMouseButton_Right;
  if (name == "middle") return ImGuiMouseButton_Middle;
  throw Error(ErrorKind::Usage, "button: expected left, right or middle, got " + name);
}

/// Whole names of modifiers, joined by "+".
ImGuiKeyChord modifiers_of(const std::string& text) {
  ImGuiKeyChord chord = 0;
  if (text.find("ctrl") != std::string::npos) chord |= ImGuiMod_Ctrl;
  if (text.find("shift") != std::string::npos) chord |= ImGuiMod_Shift;
  if (text.find("alt") != std::string::npos) chord |= ImGuiMod_Alt;
  return chord;
}

void hold(ImGuiKeyChord modifiers, bool down) {
  ImGuiIO& io = ImGui::GetIO();
  for (const ImGuiKey key : {ImGuiMod_Ctrl, ImGuiMod_Shift, ImGuiMod_Alt}) {
    if ((modifiers & key) != 0) io.AddKeyEvent(key, down);
  }
}

std::optional<WidgetMap::Place> visible_place(Application& application, const std::string& name) {
  const auto& places = application.gui().widgets().places;
  const auto found = places.find(name);
  if (found == places.end() || !found->second.visible) return std::nullopt;
  return found->second;
}

/// Scrolls the panel so that the widget at `place` comes to its middle.
void scroll_to(const std::string& window, const WidgetMap::Place& place) {
  ImGuiWindow* target = ImGui::FindWindowByName(window.c_str());
  if (target == nullptr) return;
  const float middle = 0.5F * (target->InnerRect.Min.y + target->InnerRect.Max.y);
  ImGui::SetScrollY(target, target->Scroll.y + 0.5F * (place.min.y + place.max.y) - middle);
}

WidgetMap::Place find_widget(Application& application, const std::string& name) {
  step_frame(application);
  if (const auto place = visible_place(application, name)) return *place;
  const std::string window = name.substr(0, name.find('/'));
  if (ImGui::FindWindowByName(window.c_str()) != nullptr) ImGui::SetWindowFocus(window.c_str());
  step_frame(application);
  step_frame(application);
  if (const auto place = visible_place(application, name)) return *place;
  const auto& places = application.gui().widgets().places;
  if (const auto hidden = places.find(name); hidden != places.end()) {
    scroll_to(window, hidden->second);
    step_frame(application);
    step_frame(application);
  }
  if (const auto place = visible_place(application, name)) return *place;
  std::string others;
  for (const auto& [other, place] : places) {
    if (other.compare(0, window.size(), window) == 0)
      others += (others.empty() ? "" : ", ") + other;
  }
  throw Error(ErrorKind::Usage, "no widget \"" + name + "\" is on screen" +
                                    (others.empty() ? "" : "; there are " + others));
}

ImVec2 point_in(const WidgetMap::Place& place, const json& at) {
  const float fx = at.is_array() ? at.at(0).get<float>() : 0.5F;
  const float fy = at.is_array() ? at.at(1).get<float>() : 0.5F;
  return {place.min.x + fx * (place.max.x - place.min.x),
          place.min.y + fy * (place.max.y - place.min.y)};
}

void move_to(Application& application, const ImVec2& point) {
  ImGui::GetIO().AddMousePosEvent(point.x, point.y);
  step_frame(application);
}

void press(Application& application, int button, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(button, down);
  step_frame(application);
}

ImGuiKey key_named(const std::string& name) {
  static const std::map<std::string, ImGuiKey> named{
      {"enter", ImGuiKey_Enter},
      {"escape", ImGuiKey_Escape},
      {"space", ImGuiKey_Space},
      {"tab", ImGuiKey_Tab},
      {"delete", ImGuiKey_Delete},
      {"home", ImGuiKey_Home},
      {"backspace", ImGuiKey_Backspace},
      {"[", ImGuiKey_LeftBracket},
      {"]", ImGuiKey_RightBracket},
      {"\\", ImGuiKey_Backslash},
      {"/", ImGuiKey_Slash},
  };
  if (const auto found = named.find(name); found != named.end()) return found->second;
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') {
    return static_cast<ImGuiKey>(ImGuiKey_A + (name[0] - 'a'));
  }
  if (name.size() == 1 && name[0] >= '0' && name[0] <= '9') {
    return static_cast<ImGuiKey>(ImGuiKey_0 + (name[0] - '0'));
  }
  if (name.size() >= 2 && name[0] == 'f') {
    const int number = std::atoi(name.c_str() + 1);
    if (number >= 1 && number <= 12) return static_cast<ImGuiKey>(ImGuiKey_F1 + number - 1);
  }
  throw Error(ErrorKind::Usage, "key: unknown key \"" + name + "\"");
}

}  // namespace

void click_widget(Application& application, const json& step) {
  const WidgetMap::Place place = find_widget(application, step.at("click"));
  const int button = button_of(step);
  const ImGuiKeyChord modifiers = modifiers_of(step.value("with", ""));
  move_to(application, point_in(place, step.value("at", json())));
  hold(modifiers, true);
  step_frame(application);
  for (int i = 0; i < step.value("times", 1); ++i) {
    press(application, button, true);
    press(application, button, false);
  }
  hold(modifiers, false);
}

void drag_widget(Application& application, const json& step) {
  const WidgetMap::Place place = find_widget(application, step.at("drag"));
  const ImVec2 from = point_in(place, step.at("from"));
  const ImVec2 to = point_in(place, step.at("to"));
  const int button = button_of(step);
  const ImGuiKeyChord modifiers = modifiers_of(step.value("with", ""));
  move_to(application, from);
  hold(modifiers, true);
  press(application, button, true);
  constexpr int kMoves = 12;
  for (int i = 1; i <= kMoves; ++i) {
    const float t = static_cast<float>(i) / kMoves;
    move_to(application, {from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
  }
  press(application, button, false);
  hold(modifiers, false);
}

void turn_wheel(Application& application, const json& step) {
  const WidgetMap::Place place = find_widget(application, step.at("wheel"));
  const ImGuiKeyChord modifiers = modifiers_of(step.value("with", ""));
  move_to(application, point_in(place, step.value("at", json())));
  hold(modifiers, true);
  ImGui::GetIO().AddMouseWheelEvent(0, step.value("turns", 1.0F));
  step_frame(application);
  hold(modifiers, false);
}

void type_text(Application& application, const std::string& text) {
  ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
  step_frame(application);
}

void press_key(Application& application, const std::string& keys) {
  const std::size_t plus = keys.rfind('+');
  const std::string name = plus == std::string::npos ? keys : keys.substr(plus + 1);
  const ImGuiKeyChord modifiers =
      modifiers_of(plus == std::string::npos ? "" : keys.substr(0, plus));
  const ImGuiKey key = key_named(name);
  ImGuiIO& io = ImGui::GetIO();
  hold(modifiers, true);
  io.AddKeyEvent(key, true);
  step_frame(application);
  step_frame(application);
  io.AddKeyEvent(key, false);
  hold(modifiers, false);
  step_frame(application);
}

}  // namespace lightbench::ui
