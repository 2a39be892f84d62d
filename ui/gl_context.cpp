#include "ui/gl_context.h"

// glad first: it stands in for GL/gl.h, which GLFW and OSMesa would include.
#include <glad/gl.h>
// What osmesa.h takes from GL/gl.h.
#ifndef GLAPI
#define GLAPI extern
#endif
#ifndef GLAPIENTRY
#define GLAPIENTRY
#endif
#include <GL/osmesa.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "core/error.h"

namespace lightbench::ui {
namespace {

void load_functions(GLADloadfunc loader) {
  if (gladLoadGL(loader) == 0) {
    throw Error(ErrorKind::Usage, "OpenGL 3.3 is needed for the window and was not found");
  }
}

}  // namespace

GlContext::GlContext(GlBackend backend, int width, int height, const std::string& title) {
  if (backend == GlBackend::Window) {
    open_window(width, height, title);
  } else {
    open_memory(width, height);
  }
}

void GlContext::open_window(int width, int height, const std::string& title) {
  glfwSetErrorCallback(nullptr);
  if (glfwInit() == GLFW_FALSE) {
    throw Error(
        ErrorKind::Usage,
        "no display for the viewer (DISPLAY and WAYLAND_DISPLAY lead nowhere); without one, "
        "use `lightbench render` or `lightbench screenshot`");
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "lightbench");
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    const char* reason = nullptr;
    glfwGetError(&reason);
    const std::string message = std::string("cannot open a window with OpenGL 3.3 (") +
                                (reason != nullptr ? reason : "no reason given") +
                                "); `lightbench render` and `lightbench screenshot` need none";
    glfwTerminate();
    throw Error(ErrorKind::Usage, message);
  }
  glfwMakeContextCurrent(window_);
  load_functions(glfwGetProcAddress);
  glfwSwapInterval(1);
}

void GlContext::open_memory(int width, int height) {
  const std::array<int, 11> attributes{OSMESA_FORMAT,
                                       OSMESA_RGBA,
                                       OSMESA_PROFILE,
                                       OSMESA_CORE_PROFILE,
                                       OSMESA_CONTEXT_MAJOR_VERSION,
                                       3,
                                       OSMESA_CONTEXT_MINOR_VERSION,
                                       3,
                                       0,
                                       0,
                                       0};
  memory_context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
  width_ = width;
  height_ = height;
  memory_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  if (memory_context_ == nullptr ||
      OSMesaMakeCurrent(memory_context_, memory_.data(), GL_UNSIGNED_BYTE, width, height) == 0) {
    throw Error(ErrorKind::Usage, "cannot make an off-screen OpenGL 3.3 context of " +
                                      std::to_string(width) + "x" + std::to_string(height));
  }
  load_functions(OSMesaGetProcAddress);
}

GlContext::~GlContext() {
  if (window_ != nullptr) {
    glfwDestroyWindow(window_);
    glfwTerminate();
  }
  if (memory_context_ != nullptr) OSMesaDestroyContext(memory_context_);
}

int GlContext::width() const {
  if (window_ == nullptr) return width_;
  int width = 0;
  glfwGetFramebufferSize(window_, &width, nullptr);
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0 ? 0 : width;
}

int GlContext::height() const {
  if (window_ == nullptr) return height_;
  int height = 0;
  glfwGetFramebufferSize(window_, nullptr, &height);
  return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0 ? 0 : height;
}

double GlContext::content_scale() const {
  if (window_ == nullptr) return 1;
  float scale = 1;
  glfwGetWindowContentScale(window_, &scale, nullptr);
  // X11 and Windows report sizes in pixels; where a unit is several pixels the framebuffer is
  // larger than the window and the layout must not grow a second time.
  int window_width = 1;
  glfwGetWindowSize(window_, &window_width, nullptr);
  int pixels = 1;
  glfwGetFramebufferSize(window_, &pixels, nullptr);
  return window_width > 0 && pixels > window_width ? 1.0 : static_cast<double>(scale);
}

void GlContext::present() {
  if (window_ != nullptr) {
    glfwSwapBuffers(window_);
  } else {
    glFinish();
  }
}

void GlContext::toggle_full_screen() {
  if (window_ == nullptr) return;
  if (glfwGetWindowMonitor(window_) != nullptr) {
    glfwSetWindowMonitor(window_, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3],
                         GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return;
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  glfwGetWindowPos(window_, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window_, &windowed_[2], &windowed_[3]);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

std::vector<std::uint8_t> GlContext::read_rgb() const {
  const int w = width();
  const int h = height();
  const auto row = static_cast<std::size_t>(w) * 3;
  std::vector<std::uint8_t> bottom_up(row * static_cast<std::size_t>(h));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, bottom_up.data());
  std::vector<std::uint8_t> rgb;
  rgb.reserve(bottom_up.size());
  for (std::size_t y = static_cast<std::size_t>(h); y-- > 0;) {
    const auto first = bottom_up.begin() + static_cast<std::ptrdiff_t>(y * row);
    rgb.insert(rgb.end(), first, first + static_cast<std::ptrdiff_t>(row));
  }
  return rgb;
}

}  // namespace lightbench::ui
