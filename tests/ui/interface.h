#pragma once
// The real interface over OSMesa, driven by Dear ImGui Test Engine.

#include <imgui_te_context.h>
#include <imgui_te_engine.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ui/application.h"

namespace lightbench::ui {

/// One viewer in memory. Scenes are small, so that a picture takes milliseconds.
class Interface {
 public:
  explicit Interface(Scene scene, const std::filesystem::path& file = {}, int width = 1280,
                     int height = 720);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Runs `steps` with the mouse and keys of the test engine; a failed step fails the test.
  void run(const std::function<void(ImGuiTestContext*)>& steps);
  /// Draws frames until the scene as edited is on screen with at least `spp` samples.
  void settle(std::uint32_t spp = 1);
  /// Draws frames until `done`, for at most half a minute; false if it never is.
  bool wait(const std::function<bool()>& done);

  [[nodiscard]] Workbench& bench() { return application_.bench(); }
  [[nodiscard]] Scene& scene() { return bench().editor.scene; }
  [[nodiscard]] Application& application() { return application_; }
  /// Linear values of the picture on screen.
  [[nodiscard]] std::vector<float> picture() { return bench().frame->image.rgb; }
  [[nodiscard]] std::vector<std::uint8_t> screen() const { return gl_.read_rgb(); }

 private:
  void frame();

  GlContext gl_;
  ImGuiTestEngine* engine_;
  Application application_;
  int tests_ = 0;
};

/// Opens the combo box `combo` and clicks its entry `item`.
void choose(ImGuiTestContext* ctx, const char* combo, const char* item);

/// One thread, no layout file, no files written.
ApplicationOptions test_options(double scale = 1);

/// The headline scene, 40 x 40 pixels and 4 samples.
Scene small_scene();
std::filesystem::path small_scene_file();

}  // namespace lightbench::ui
