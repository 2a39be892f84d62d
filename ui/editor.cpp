#include "ui/editor.h"

#include <utility>

#include "core/error.h"
#include "core/scene/scene_io.h"
#include "ui/scene_edit.h"

namespace lightbench::ui {
namespace {
constexpr std::size_t kMaxSteps = 500;
}

Editor::Editor(Scene initial, std::filesystem::path file) {
  open(std::move(initial), std::move(file));
}

void Editor::open(Scene opened, std::filesystem::path from) {
  scene = std::move(opened);
  saved_ = scene;
  history_.assign(1, scene);
  position_ = 0;
  selection = {};
  file_ = std::move(from);
}

std::string Editor::commit() {
  if (scene == history_[position_]) return {};
  try {
    validate(scene);
  } catch (const Error& error) {
    show(position_);
    return error.what();
  }
  history_.resize(position_ + 1);
  history_.push_back(scene);
  if (history_.size() > kMaxSteps) history_.erase(history_.begin());
  position_ = history_.size() - 1;
  return {};
}

bool Editor::can_undo() const { return position_ > 0 || scene != history_[position_]; }

bool Editor::undo() {
  commit();
  if (position_ == 0) return false;
  show(position_ - 1);
  return true;
}

bool Editor::redo() {
  commit();
  if (!can_redo()) return false;
  show(position_ + 1);
  return true;
}

void Editor::show(std::size_t position) {
  position_ = position;
  scene = history_[position];
  if (!is_valid(scene, selection)) selection = {};
}

void Editor::saved(const Scene& written, std::filesystem::path to) {
  saved_ = written;
  file_ = std::move(to);
}

std::string Editor::title() const { return file_.empty() ? "untitled" : file_.stem().string(); }

std::filesystem::path Editor::directory() const {
  return file_.has_parent_path() ? file_.parent_path() : std::filesystem::path(".");
}

}  // namespace lightbench::ui
