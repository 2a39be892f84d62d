#include "ui/gui.h"

#include <glad/gl.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>

#include <cstdlib>
#include <system_error>

#include "ui/theme.h"

namespace lightbench::ui {

Gui::Gui(GlContext& gl, double scale, const std::filesystem::path& layout_file)
    : gl_(gl), layout_file_(layout_file.string()) {
  context_ = ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags |= ImGuiConfigFlags_DockingEnable;
  // A blinking cursor would redraw an idle window for ever.
  io.ConfigInputTextCursorBlink = false;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.IniFilename = layout_file_.empty() ? nullptr : layout_file_.c_str();
  io.LogFilename = nullptr;
  io.UserData = &widgets_;
  load_fonts();
  set_scale(scale);
  if (gl_.window() != nullptr) ImGui_ImplGlfw_InitForOpenGL(gl_.window(), true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  if (gl_.window() != nullptr) ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(context_);
}

void Gui::begin_frame(double seconds) {
  ImGui_ImplOpenGL3_NewFrame();
  if (gl_.window() != nullptr) {
    ImGui_ImplGlfw_NewFrame();
  } else {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(gl_.width()), static_cast<float>(gl_.height())};
    io.DeltaTime = static_cast<float>(seconds > 0 ? seconds : 1.0 / 60);
  }
  widgets_.places.clear();
  ImGui::NewFrame();
}

void Gui::note_tabs() {
  for (const ImGuiWindow* window : context_->Windows) {
    if (!window->DockIsActive || window->DockNode == nullptr || !window->WasActive) continue;
    const ImRect& tab = window->DC.DockTabItemRect;
    widgets_.places["Tab/" + std::string(window->Name)] = {tab.Min, tab.Max, tab.GetWidth() > 0};
  }
}

void Gui::end_frame() {
  note_tabs();
  ImGui::Render();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, gl_.width(), gl_.height());
  const ImVec4& background = kPalette.surround;
  glClearColor(background.x, background.y, background.z, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  gl_.present();
}

bool Gui::input_waits() const { return !context_->InputEventsQueue.empty(); }

void Gui::set_scale(double scale) {
  scale_ = scale;
  apply_theme(static_cast<float>(scale));
}

std::filesystem::path default_layout_file() {
  std::filesystem::path folder;
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state != nullptr && state[0] == '/') {
    folder = state;
  } else if (home != nullptr && home[0] == '/') {
    folder = std::filesystem::path(home) / ".local" / "state";
  } else {
    return {};
  }
  folder /= "lightbench";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  return error ? std::filesystem::path{} : folder / "layout.ini";
}

}  // namespace lightbench::ui
