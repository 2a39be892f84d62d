// The house: app over ui over core. Core knows no window, OpenGL or Dear ImGui, neither in its
// sources nor in what it links.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace lightbench {
namespace {

namespace fs = std::filesystem;

/// Lines "file: include" of #include directives below `folder` whose target matches `forbidden`.
std::vector<std::string> includes(const std::string& folder, const std::string& forbidden) {
  const std::regex directive("^\\s*#\\s*include\\s*[<\"](" + forbidden + ")", std::regex::icase);
  std::vector<std::string> found;
  int files = 0;
  for (const auto& entry :
       fs::recursive_directory_iterator(fs::path(LIGHTBENCH_SOURCE_DIR) / folder)) {
    if (!entry.is_regular_file()) continue;
    ++files;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      if (std::regex_search(line, directive)) found.push_back(entry.path().string() + ": " + line);
    }
  }
  EXPECT_GT(files, 0) << "nothing to scan in " << folder;
  return found;
}

TEST(Layers, CoreIncludesNoWindowOrGl) {
  for (const auto& line :
       includes("core", ".*(glfw|glad|osmesa|imgui|implot|imguizmo|X11/)|GL/|EGL/|GLES")) {
    ADD_FAILURE() << line;
  }
}

TEST(Layers, CoreIncludesNothingAboveIt) {
  for (const auto& line : includes("core", "(ui|app|tests)/")) ADD_FAILURE() << line;
}

TEST(Layers, UiIncludesNothingAboveIt) {
  for (const auto& line : includes("ui", "(app|tests)/")) ADD_FAILURE() << line;
}

// This test program links core and no UI, so whatever core needs is mapped into it.
TEST(Layers, CoreLinksNoWindowOrGl) {
  std::ifstream maps("/proc/self/maps");
  ASSERT_TRUE(maps) << "needs Linux";
  const std::regex forbidden("/lib(GL|EGL|OSMesa|glapi|glfw|X11|xcb|wayland)[^/]*$");
  for (std::string line; std::getline(maps, line);) {
    EXPECT_FALSE(std::regex_search(line, forbidden)) << line;
  }
}

}  // namespace
}  // namespace lightbench
