#include "ui/window_loop.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cmath>
#include <utility>

#include "core/session/priority.h"

namespace lightbench::ui {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
// Layout units; below them the picture has no room beside the panels.
constexpr int kLeastWidth = 640;
constexpr int kLeastHeight = 400;
constexpr double kLongestWait = 3600;

void wait_for_events(double seconds) {
  if (seconds <= 0) {
    glfwPollEvents();
  } else {
    glfwWaitEventsTimeout(std::min(seconds, kLongestWait));
  }
}

void show_title(GLFWwindow* window, const Editor& editor, std::string& shown) {
  std::string title = editor.title() + (editor.dirty() ? "* - Lightbench" : " - Lightbench");
  if (title == shown) return;
  glfwSetWindowTitle(window, title.c_str());
  shown = std::move(title);
}

bool is_minimised(const GlContext& gl) { return gl.width() == 0 || gl.height() == 0; }

}  // namespace

void run_window(Scene scene, const std::filesystem::path& file, const ApplicationOptions& options) {
  GlContext gl(GlBackend::Window, kWidth, kHeight, "Lightbench");
  GLFWwindow* window = gl.window();
  const double scale = gl.content_scale();
  glfwSetWindowSizeLimits(window, static_cast<int>(kLeastWidth * scale),
                          static_cast<int>(kLeastHeight * scale), GLFW_DONT_CARE, GLFW_DONT_CARE);
  // An uncovered or resized window must be drawn again although no widget changed.
  bool exposed = true;
  glfwSetWindowUserPointer(window, &exposed);
  glfwSetWindowRefreshCallback(
      window, [](GLFWwindow* w) { *static_cast<bool*>(glfwGetWindowUserPointer(w)) = true; });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) {
    *static_cast<bool*>(glfwGetWindowUserPointer(w)) = true;
  });
  Application application(gl, std::move(scene), file, options, glfwPostEmptyEvent);
  react_promptly();
  std::string title;
  while (!application.closing()) {
    wait_for_events(is_minimised(gl) ? kLongestWait
                                     : (exposed ? 0 : application.seconds_to_next_frame()));
    if (glfwWindowShouldClose(window) == GLFW_TRUE) {
      glfwSetWindowShouldClose(window, GLFW_FALSE);
      application.ask_to_quit();
      // There may be changes to ask about.
      if (is_minimised(gl)) glfwRestoreWindow(window);
    }
    if (is_minimised(gl)) {
      application.keep_snapshots();
      continue;
    }
    if (!exposed && application.seconds_to_next_frame() > 0) continue;
    exposed = false;
    application.frame();
    show_title(window, application.bench().editor, title);
  }
}

}  // namespace lightbench::ui
