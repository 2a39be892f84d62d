#pragma once
// The scene being edited, what is selected, and its history: undo is a list of Scenes, which is
// cheap because meshes and images are shared.

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "ui/selection.h"

namespace lightbench::ui {

/// Panels write to `scene` and `selection` directly; the application compares values once per
/// frame. UI thread only.
class Editor {
 public:
  explicit Editor(Scene initial, std::filesystem::path file = {});

  Scene scene;
  Selection selection;

  /// Replaces everything by another document; the history starts anew.
  void open(Scene opened, std::filesystem::path from);

  /// Makes the current scene an undo step if it differs from the last one. A scene that validate()
  /// rejects is put back to the last step instead, and the reason returned; otherwise "".
  std::string commit();
  /// Steps through the history, committing first. False at its end.
  bool undo();
  bool redo();
  [[nodiscard]] bool can_undo() const;
  [[nodiscard]] bool can_redo() const { return position_ + 1 < history_.size(); }

  /// True if the scene differs from the file.
  [[nodiscard]] bool dirty() const { return scene != saved_; }
  /// Notes that `written` is now what `to` holds.
  void saved(const Scene& written, std::filesystem::path to);
  /// Empty for a scene that was never saved.
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// File name without extension, or "untitled".
  [[nodiscard]] std::string title() const;
  /// Folder that relative asset names start from.
  [[nodiscard]] std::filesystem::path directory() const;

 private:
  void show(std::size_t position);

  std::filesystem::path file_;
  Scene saved_;
  std::vector<Scene> history_;  ///< never empty; history_[position_] is the last step
  std::size_t position_ = 0;
};

}  // namespace lightbench::ui
