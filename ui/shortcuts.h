#pragma once
// The one table of keys: what they do, how menus print them, what F1 lists.

#include <imgui.h>

#include <optional>
#include <string>
#include <vector>

namespace lightbench::ui {

/// Everything a key, a menu or a button can ask the application for.
enum class Action {
  None,
  NewScene,
  Open,
  Save,
  SaveAs,
  Quit,
  SaveAndContinue,  // answers to "save changes?"
  DiscardAndContinue,
  Undo,
  Redo,
  Duplicate,
  Delete,
  FrameSelection,
  FrameAll,
  PauseResume,
  Restart,
  SnapshotNow,
  ExposureUp,
  ExposureDown,
  ExposureUpFine,
  ExposureDownFine,
  ExposureReset,
  ZoomFit,
  ZoomActual,
  ToggleHelp,
  TogglePanels,
  ToggleFullScreen,
  ResetLayout,
};

struct Shortcut {
  Action action;
  ImGuiKeyChord chord;  ///< 0 = mouse gesture, listed only
  const char* keys;     ///< as printed
  const char* label;
  const char* group;
};

const std::vector<Shortcut>& shortcuts();

/// Keys of an action as menus print them, "" if it has none.
const char* shortcut_keys(Action action);

/// The action whose keys were pressed in this frame, unless a text is being typed.
std::optional<Action> pressed_action();

}  // namespace lightbench::ui
