#pragma once
// Stored scenes in small.

#include <string>
#include <utility>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

/// By name: scenes that together use every shape, material, texture, medium, lens and light, at
/// this many pixels.
std::vector<std::pair<std::string, Scene>> small_scenes(int width, int height);

}  // namespace lightbench
