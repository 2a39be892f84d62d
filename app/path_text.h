#pragma once
// The path of one sample, for people to read: render --debug-sample.

#include <string>

#include "core/query/path.h"
#include "core/scene/scene.h"

namespace lightbench {

std::string path_text(const Scene& scene, const RenderScene& compiled, const SampleName& name,
                      const PathRecord& path);

}  // namespace lightbench
