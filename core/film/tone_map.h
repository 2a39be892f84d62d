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

/// exposure (stops), operator, sRGB curve; result in [0,1]. Each channel x, limited to [0, 1e6]
/// (NaN is 0): Srgb min(x, 1); Reinhard x / (1 + x); Aces min(1, x (2.51 x + 0.03) / (x (2.43 x +
/// 0.59) + 0.14)), Narkowicz 2015. All rise from 0 to 1.
std::array<float, 3> display_value(const std::array<float, 3>& radiance, const Display& display);

/// 8-bit RGB, rounded to nearest, top row first.
std::vector<std::uint8_t> to_8_bit(const Image& image, const Display& display);

}  // namespace lightbench
