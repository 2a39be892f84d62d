#include "ui/shortcuts.h"

namespace lightbench::ui {
namespace {

constexpr const char* kFileGroup = "File";
constexpr const char* kEditGroup = "Edit";
constexpr const char* kRenderGroup = "Render";
constexpr const char* kPictureGroup = "Picture";
constexpr const char* kCameraGroup = "Camera";
constexpr const char* kWindowGroup = "Window";

}  // namespace

const std::vector<Shortcut>& shortcuts() {
  static const std::vector<Shortcut> table{
      {Action::NewScene, ImGuiMod_Ctrl | ImGuiKey_N, "Ctrl+N", "New scene", kFileGroup},
      {Action::Open, ImGuiMod_Ctrl | ImGuiKey_O, "Ctrl+O", "Open scene", kFileGroup},
      {Action::Save, ImGuiMod_Ctrl | ImGuiKey_S, "Ctrl+S", "Save scene", kFileGroup},
      {Action::SaveAs, ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_S, "Ctrl+Shift+S", "Save scene as",
       kFileGroup},
      {Action::Quit, ImGuiMod_Ctrl | ImGuiKey_Q, "Ctrl+Q", "Quit", kFileGroup},
      {Action::Undo, ImGuiMod_Ctrl | ImGuiKey_Z, "Ctrl+Z", "Undo", kEditGroup},
      {Action::Redo, ImGuiMod_Ctrl | ImGuiMod_Shift | ImGuiKey_Z, "Ctrl+Shift+Z", "Redo",
       kEditGroup},
      {Action::Redo, ImGuiMod_Ctrl | ImGuiKey_Y, "Ctrl+Y", "Redo", kEditGroup},
      {Action::Duplicate, ImGuiMod_Ctrl | ImGuiKey_D, "Ctrl+D", "Duplicate selection", kEditGroup},
      {Action::Delete, ImGuiKey_Delete, "Delete", "Delete selection", kEditGroup},
      {Action::PauseResume, ImGuiKey_Space, "Space", "Pause or resume", kRenderGroup},
      {Action::Restart, ImGuiMod_Ctrl | ImGuiKey_R, "Ctrl+R", "Restart", kRenderGroup},
      {Action::SnapshotNow, ImGuiKey_F12, "F12", "Snapshot now", kRenderGroup},
      {Action::ExposureUp, ImGuiKey_RightBracket, "]", "Exposure up, 1/2 stop", kPictureGroup},
      {Action::ExposureDown, ImGuiKey_LeftBracket, "[", "Exposure down, 1/2 stop", kPictureGroup},
      {Action::ExposureUpFine, ImGuiMod_Shift | ImGuiKey_RightBracket, "Shift+]",
       "Exposure up, 1/6 stop", kPictureGroup},
      {Action::ExposureDownFine, ImGuiMod_Shift | ImGuiKey_LeftBracket, "Shift+[",
       "Exposure down, 1/6 stop", kPictureGroup},
      {Action::ExposureReset, ImGuiKey_Backslash, "\\", "Exposure 0", kPictureGroup},
      {Action::ZoomFit, ImGuiMod_Ctrl | ImGuiKey_0, "Ctrl+0", "Fit the picture", kPictureGroup},
      {Action::ZoomActual, ImGuiMod_Ctrl | ImGuiKey_1, "Ctrl+1", "One pixel per pixel",
       kPictureGroup},
      {Action::None, 0, "Ctrl+wheel", "Zoom the picture", kPictureGroup},
      {Action::None, 0, "Ctrl+middle drag", "Move the zoomed picture", kPictureGroup},
      {Action::None, 0, "Click", "Select object", kPictureGroup},
      {Action::None, 0, "Left drag", "Orbit", kCameraGroup},
      {Action::None, 0, "Middle drag", "Pan", kCameraGroup},
      {Action::None, 0, "Wheel", "Dolly", kCameraGroup},
      {Action::None, 0, "Right drag", "Look around", kCameraGroup},
      {Action::None, 0, "Right + W A S D", "Fly", kCameraGroup},
      {Action::None, 0, "Right + Q / E", "Fly down / up", kCameraGroup},
      {Action::None, 0, "Right + wheel", "Fly slower / faster", kCameraGroup},
      {Action::None, 0, "Right + Shift", "Fly fast", kCameraGroup},
      {Action::None, 0, "Shift+click", "Focus here", kCameraGroup},
      {Action::None, 0, "Ctrl+click", "Orbit about this point", kCameraGroup},
      {Action::FrameSelection, ImGuiKey_F, "F", "Frame selection", kCameraGroup},
      {Action::FrameAll, ImGuiKey_Home, "Home", "Frame all", kCameraGroup},
      {Action::ToggleHelp, ImGuiKey_F1, "F1", "Keys", kWindowGroup},
      {Action::ToggleHelp, ImGuiMod_Shift | ImGuiKey_Slash, "?", "Keys", kWindowGroup},
      {Action::TogglePanels, ImGuiMod_Ctrl | ImGuiKey_B, "Ctrl+B", "Picture only", kWindowGroup},
      {Action::ToggleFullScreen, ImGuiKey_F11, "F11", "Full screen", kWindowGroup},
  };
  return table;
}

const char* shortcut_keys(Action action) {
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.action == action) return shortcut.keys;
  }
  return "";
}

std::optional<Action> pressed_action() {
  const bool typing = ImGui::GetIO().WantTextInput;
  for (const Shortcut& shortcut : shortcuts()) {
    if (shortcut.chord == 0) continue;
    const bool repeats =
        shortcut.action == Action::Undo || shortcut.action == Action::Redo ||
        (shortcut.action >= Action::ExposureUp && shortcut.action <= Action::ExposureDownFine);
    const auto key = static_cast<ImGuiKey>(shortcut.chord & ~ImGuiMod_Mask_);
    const bool function_key = key >= ImGuiKey_F1 && key <= ImGuiKey_F24;
    if (typing && !function_key) continue;  // the text field's
    if (ImGui::GetIO().KeyMods == (shortcut.chord & ImGuiMod_Mask_) &&
        ImGui::IsKeyPressed(key, repeats)) {
      return shortcut.action;
    }
  }
  return std::nullopt;
}

}  // namespace lightbench::ui
