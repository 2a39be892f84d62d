#include "core/film/tone_map.h"

#include <algorithm>
#include <cmath>

namespace lightbench {
namespace {

// Beyond this every operator has reached white; it keeps squares and quotients finite.
constexpr float kWhite = 1e6F;

/// [0, kWhite]; NaN and negative values are black.
float bounded(float value) { return value > 0 ? std::min(value, kWhite) : 0.0F; }

// Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", equation 3, applied to
// each channel: bright saturated lights fade to white instead of clipping to a flat hue.
float reinhard(float x) { return x / (1 + x); }

// Narkowicz 2015, "ACES Filmic Tone Mapping Curve": a rational fit of the ACES RRT + sRGB ODT. It
// exceeds 1 by 3 %, hence the clip.
float aces(float x) {
  return std::min(1.0F, x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F));
}

float curve(float x, ToneMap tone_map) {
  switch (tone_map) {
    case ToneMap::Reinhard:
      return reinhard(x);
    case ToneMap::Aces:
      return aces(x);
    case ToneMap::Srgb:
      break;
  }
  return std::min(x, 1.0F);
}

std::uint8_t byte(float value) { return static_cast<std::uint8_t>(std::lround(value * 255.0F)); }

}  // namespace

float srgb_from_linear(float linear) {
  if (linear <= 0.0031308F) return 12.92F * linear;
  return 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

float linear_from_srgb(float encoded) {
  if (encoded <= 0.04045F) return encoded / 12.92F;
  return std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

std::array<float, 3> display_value(const std::array<float, 3>& radiance, const Display& display) {
  const auto gain = static_cast<float>(std::exp2(display.exposure));
  std::array<float, 3> result{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float mapped = curve(bounded(radiance[c] * gain), display.tone_map);
    result[c] = std::clamp(srgb_from_linear(mapped), 0.0F, 1.0F);
  }
  return result;
}

std::vector<std::uint8_t> to_8_bit(const Image& image, const Display& display) {
  std::vector<std::uint8_t> bytes(image.rgb.size());
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
    const auto value = display_value({image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]}, display);
    for (std::size_t c = 0; c < 3; ++c) bytes[i + c] = byte(value[c]);
  }
  return bytes;
}

}  // namespace lightbench
