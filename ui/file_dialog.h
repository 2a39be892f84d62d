#pragma once
// Choosing a file, drawn by ImGui: works without a desktop, over OSMesa and under test alike.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace lightbench::ui {

struct FileQuestion {
  std::string title;                    ///< also the label of the button that answers
  bool save = false;                    ///< the file may be new; replacing one is asked twice
  std::filesystem::path start;          ///< folder, or file to propose
  std::vector<std::string> extensions;  ///< ".json"; others are hidden; empty = all
  std::function<void(const std::filesystem::path&)> chosen;
};

class FileDialog {
 public:
  void ask(FileQuestion question);
  /// Call once per frame.
  void draw();
  [[nodiscard]] bool is_open() const { return open_; }

 private:
  struct Entry {
    std::string name;
    bool folder = false;
  };
  void go_to(const std::filesystem::path& folder);
  void draw_list();
  void answer();

  FileQuestion question_;
  bool open_ = false;
  bool starting_ = false;
  bool confirm_replace_ = false;
  std::filesystem::path folder_;
  std::string name_;
  std::string problem_;
  std::vector<Entry> entries_;
};

}  // namespace lightbench::ui
