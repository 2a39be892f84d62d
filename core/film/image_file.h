#pragma once
// Image files by extension. PNG and PPM are display-referred (exposure, tone map, sRGB); EXR, HDR
// and PFM hold linear radiance. Files are written to a temporary name in the same folder, then
// renamed.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/scene/image.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Text stored in PNG and EXR headers: software, scene, samplesPerPixel, renderTimeSeconds, seed...
using ImageMetadata = std::map<std::string, std::string>;

/// Throws Error{Usage} unless `file` ends in .png .exr .hdr .pfm .ppm; call before a long render.
void check_image_name(const std::filesystem::path& file);

/// Number type of the colours of an EXR file. Half keeps three digits, up to 65504, and is what
/// viewers expect.
enum class ExrNumbers { Half, Float };

/// Throws Error{Output} if it cannot be written. `variance` (one float per pixel) becomes an EXR
/// channel `variance.Y`; other formats ignore it. Creates missing folders.
void write_image(const std::filesystem::path& file, const Image& image, const Display& display,
                 const ImageMetadata& metadata = {}, const std::vector<float>& variance = {},
                 ExrNumbers numbers = ExrNumbers::Half);

/// The text in the header of an EXR file; empty for other formats. Throws Error{Scene}.
ImageMetadata read_image_metadata(const std::filesystem::path& file);

/// Linear values of .png .jpg .exr .hdr .pfm .ppm (8-bit formats decoded from sRGB if `srgb`).
/// Throws Error{Scene}.
Image read_image(const std::filesystem::path& file, bool srgb = true);

}  // namespace lightbench
