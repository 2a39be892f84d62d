#pragma once
// Scripted use of the interface, for screenshots and tests: named steps, run one after another on
// an off-screen application. docs/viewer.md describes the file.

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "ui/application.h"

namespace lightbench::ui {

/// Draws one UI frame.
void step_frame(Application& application);

/// Draws frames until the newest scene has `spp` samples on screen, or its target if that is lower.
/// `report` is called now and then with the samples so far. Throws Error{Scene} if the session
/// fails.
void wait_for_samples(Application& application, std::uint32_t spp,
                      const std::function<void(std::uint32_t)>& report = {});

/// The interface as last drawn, as a PNG or PPM.
void write_screenshot(const GlContext& gl, const std::filesystem::path& file);

/// Runs every step of `steps` (an array). Throws Error{Usage} that names the step if one cannot be
/// done: an unknown step, a widget that is not there.
void run_script(Application& application, const GlContext& gl, const nlohmann::json& steps);

}  // namespace lightbench::ui
