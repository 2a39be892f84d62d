#include "tests/ui/interface.h"

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <chrono>
#include <thread>

#include "core/scene/scene_io.h"

namespace lightbench::ui {
void choose(ImGuiTestContext* ctx, const char* combo, const char* item) {
  ctx->ItemClick(combo);
  const ImGuiWindow* list = ctx->GetWindowByRef("//$FOCUSED");
  ctx->ItemClick((std::string("//") + list->Name + "/**/" + item).c_str());
}

ApplicationOptions test_options(double scale) {
  ApplicationOptions options;
  options.threads = 1;
  options.scale = scale;
  options.write_snapshots = false;
  return options;
}

std::filesystem::path small_scene_file() {
  return std::filesystem::path(LIGHTBENCH_SOURCE_DIR) / "scenes" / "cornell-three-lights.json";
}

Scene small_scene() {
  return load_scene(small_scene_file(), {{"/render/resolution", "[40, 40]"}, {"/render/spp", "4"}});
}

Interface::Interface(Scene scene, const std::filesystem::path& file, int width, int height)
    : gl_(GlBackend::OSMesa, width, height, ""),
      engine_(ImGuiTestEngine_CreateContext()),
      application_(gl_, std::move(scene), file, test_options(), [] {}) {
  ImGuiTestEngineIO& io = ImGuiTestEngine_GetIO(engine_);
  io.ConfigSavedSettings = false;
  io.ConfigRestoreFocusAfterTests = false;
  io.ConfigVerboseLevelOnError = ImGuiTestVerboseLevel_Debug;
  ImGuiTestEngine_Start(engine_, ImGui::GetCurrentContext());
  for (int i = 0; i < 3; ++i) frame();
}

Interface::~Interface() {
  ImGuiTestEngine_Stop(engine_);
  // The engine notices by itself that its ImGui context goes first, with the application.
  ImGuiTestEngine_DestroyContext(engine_);
}

void Interface::frame() {
  application_.frame(1.0 / 60);
  ImGuiTestEngine_PostSwap(engine_);
}

void Interface::run(const std::function<void(ImGuiTestContext*)>& steps) {
  const std::string name = "steps " + std::to_string(++tests_);
  ImGuiTest* test = ImGuiTestEngine_RegisterTest(engine_, "lightbench", name.c_str());
  test->SetOwnedName(name.c_str());
  test->TestFunc = steps;
  ImGuiTestEngine_QueueTest(engine_, test, ImGuiTestRunFlags_None);
  while (!ImGuiTestEngine_IsTestQueueEmpty(engine_)) frame();
  ImGuiTextBuffer log;
  test->Output.Log.ExtractLinesForVerboseLevels(ImGuiTestVerboseLevel_Error,
                                                ImGuiTestVerboseLevel_Debug, &log);
  EXPECT_EQ(test->Output.Status, ImGuiTestStatus_Success) << log.c_str();
}

bool Interface::wait(const std::function<bool()>& done) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!done()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    frame();
    std::this_thread::yield();
  }
  return true;
}

void Interface::settle(std::uint32_t spp) {
  frame();  // submits what was edited last
  EXPECT_TRUE(wait([&] {
    const auto& shown = bench().frame;
    return shown && shown->divider == 1 && shown->generation >= application_.generation() &&
           shown->spp >= spp;
  }));
}

}  // namespace lightbench::ui
