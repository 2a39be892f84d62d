#include "ui/file_dialog.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "ui/icons.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {
namespace fs = std::filesystem;

bool has_extension(const fs::path& file, const std::vector<std::string>& extensions) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extensions.empty() ||
         std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

/// Edits `text` in place; true when Enter ends it.
bool text_input(const char* id, std::string& text) {
  return ImGui::InputText(id, &text, ImGuiInputTextFlags_EnterReturnsTrue);
}

}  // namespace

void FileDialog::ask(FileQuestion question) {
  question_ = std::move(question);
  open_ = starting_ = true;
  std::error_code error;
  const fs::path start = fs::absolute(question_.start, error);
  const bool folder = fs::is_directory(start, error);
  name_ = folder ? "" : start.filename().string();
  go_to(folder ? start : start.parent_path());
}

void FileDialog::go_to(const fs::path& folder) {
  confirm_replace_ = false;
  problem_.clear();
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(folder, error);
  fs::directory_iterator files(canonical, fs::directory_options::skip_permission_denied, error);
  if (error) {
    problem_ = "Cannot open folder " + folder.string();
    return;
  }
  folder_ = std::move(canonical);
  entries_.clear();
  for (; files != fs::directory_iterator(); files.increment(error)) {
    const std::string name = files->path().filename().string();
    std::error_code ignored;
    const bool is_folder = files->is_directory(ignored);
    if (name.front() == '.' || (!is_folder && !has_extension(name, question_.extensions))) continue;
    entries_.push_back({name, is_folder});
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : a.name < b.name;
  });
}

void FileDialog::answer() {
  if (name_.empty()) return;
  fs::path file = folder_ / name_;
  std::error_code error;
  if (fs::is_directory(file, error)) {
    name_.clear();
    go_to(file);
    return;
  }
  if (question_.save && !file.has_extension() && !question_.extensions.empty()) {
    file += question_.extensions.front();
  }
  const bool exists = fs::exists(file, error);
  if (!question_.save && !exists) {
    problem_ = file.filename().string() + " does not exist";
    return;
  }
  if (question_.save && exists && !confirm_replace_) {
    confirm_replace_ = true;
    problem_ = file.filename().string() + " exists and would be replaced";
    return;
  }
  open_ = false;
  question_.chosen(file);
}

void FileDialog::draw_list() {
  const float footer = 3 * ImGui::GetFrameHeightWithSpacing();
  if (ImGui::BeginChild("files", {0, -footer}, ImGuiChildFlags_FrameStyle)) {
    std::string enter;
    for (const Entry& entry : entries_) {
      const std::string label =
          std::string(entry.folder ? icon::kFolder : icon::kFile) + "  " + entry.name;
      if (ImGui::Selectable(label.c_str(), entry.name == name_,
                            ImGuiSelectableFlags_AllowDoubleClick)) {
        confirm_replace_ = false;
        problem_.clear();
        if (entry.folder) {
          if (ImGui::IsMouseDoubleClicked(0)) enter = entry.name;
        } else {
          name_ = entry.name;
          if (ImGui::IsMouseDoubleClicked(0)) answer();
        }
      }
      note_widget(entry.name.c_str());
    }
    if (!enter.empty()) go_to(folder_ / enter);
  }
  ImGui::EndChild();
}

void FileDialog::draw() {
  if (!open_) return;
  const std::string title = question_.title + "##file dialog";
  if (starting_) ImGui::OpenPopup(title.c_str());
  const float em = ImGui::GetFontSize();
  const ImVec2 screen = ImGui::GetMainViewport()->WorkSize;
  ImGui::SetNextWindowSize({std::min(38 * em, screen.x), std::min(28 * em, screen.y)},
                           ImGuiCond_Appearing);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5F, 0.5F});
  bool keep = true;
  if (!ImGui::BeginPopupModal(title.c_str(), &keep, ImGuiWindowFlags_NoSavedSettings)) {
    if (!starting_) open_ = false;
    starting_ = false;
    return;
  }
  if (ImGui::Button("Up")) go_to(folder_.parent_path());
  note_widget("Up");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  std::string folder = folder_.string();
  if (text_input("##folder", folder)) go_to(folder);
  note_widget("Folder");
  draw_list();
  if (starting_) ImGui::SetKeyboardFocusHere();
  starting_ = false;
  ImGui::SetNextItemWidth(-FLT_MIN);
  const std::string before = name_;
  const bool entered = text_input("##name", name_);
  note_widget("Name");
  if (name_ != before) {
    confirm_replace_ = false;
    problem_.clear();
  }
  ImGui::TextColored(confirm_replace_ ? kPalette.accent : kPalette.error, "%s", problem_.c_str());
  const ImVec2 button{7 * em, 0};
  const float buttons = 2 * button.x + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - buttons);
  if (ImGui::Button("Cancel", button) || !keep || ImGui::IsKeyPressed(ImGuiKey_Escape)) {
    open_ = false;
  }
  note_widget("Cancel");
  ImGui::SameLine();
  const char* verb = confirm_replace_ ? "Replace" : (question_.save ? "Save" : "Open");
  ImGui::BeginDisabled(name_.empty());
  const bool clicked = ImGui::Button(verb, button);
  ImGui::EndDisabled();
  note_widget("Confirm");
  if (clicked || entered) answer();
  if (!open_) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace lightbench::ui
