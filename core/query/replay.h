#pragma once
// The command line that shows one sample again, to copy from statistics.

#include <string>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

namespace lightbench {

/// `lightbench render FILE ... --debug-sample x,y,k`, quoted for a shell. Settings that a sample
/// depends on are given with it; `definitions` are the values set by --set.
std::string replay_command(const std::string& file, const RenderSettings& settings,
                           const std::string& kernel, const SampleName& name,
                           const std::vector<std::string>& definitions = {});

}  // namespace lightbench
