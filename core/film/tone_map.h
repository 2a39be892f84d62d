#pragma once
// Linear radiance to display values: the formulas that saved 8-bit files use and that the
// viewport's shader repeats (ui/viewport; a test compares the two within 1/255).

#include <array>
#include <cstdint>
#include <vector>

#include "core/scene/image.h"
#include "core/scene/scene.h"

namespace lightbench {

/// sRGB transfer function (IEC 61966-2-1), both ways, on [0,1].
float srgb_from_linear(float linear);
float linear_from_srgb(float encoded);

/// exposure (stops), operator, sRGB curve; result in [0,1].
std::array<float, 3> display_value(const std::array<float, 3>& radiance, const Display& display);

/// 8-bit RGB, rounded to nearest, top row first.
std::vector<std::uint8_t> to_8_bit(const Image& image, const Display& display);

}  // namespace lightbench
