#pragma once
// Values written on the command line. Each function throws Error{Usage} that names `flag`, shows
// the text and says what was expected.

#include <string>
#include <utility>
#include <vector>

#include "core/compile/render_scene.h"
#include "core/scene/scene.h"

namespace lightbench {

struct Resolution {
  int width = 0;
  int height = 0;
};

/// `1280x720`, or `720p` `1080p` `1440p` `2160p` `4K` `8K` (16:9).
Resolution parse_resolution(const std::string& flag, const std::string& text);

/// Seconds: `90`, `90s`, `2m`, `1.5h`; above 0.
double parse_duration(const std::string& flag, const std::string& text);

/// `x,y,width,height` in pixels.
Crop parse_crop(const std::string& flag, const std::string& text);

/// `x,y,k`: pixel and sample index.
SampleName parse_sample(const std::string& flag, const std::string& text);

/// `10,200,1000`: ascending without repeats. A lone 0 means no limit and gives an empty list.
std::vector<int> parse_counts(const std::string& flag, const std::string& text);

/// Throws too if this processor does not run the kernel.
KernelKind parse_kernel(const std::string& flag, const std::string& text);

/// `/json/pointer=value`, the two halves.
std::pair<std::string, std::string> parse_definition(const std::string& flag,
                                                     const std::string& text);

}  // namespace lightbench
