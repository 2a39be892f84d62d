#include "app/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.h"

namespace lightbench {
namespace {

[[noreturn]] void reject(const std::string& flag, const std::string& text,
                         std::string_view expected) {
  throw Error(ErrorKind::Usage, fmt::format("{} '{}': expected {}", flag, text, expected));
}

/// The whole of `text` as a number, or nothing.
template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find(separator, start);
    parts.push_back(text.substr(start, end == text.npos ? end : end - start));
    if (end == text.npos) return parts;
    start = end + 1;
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

Resolution parse_resolution(const std::string& flag, const std::string& text) {
  static constexpr std::string_view kExpected =
      "WIDTHxHEIGHT such as 1280x720, or 720p, 1080p, 1440p, 2160p, 4K, 8K";
  const std::string name = lower(text);
  if (name == "4k") return {3840, 2160};
  if (name == "8k") return {7680, 4320};
  for (const int height : {720, 1080, 1440, 2160}) {
    if (name == fmt::format("{}p", height)) return {height * 16 / 9, height};
  }
  const auto parts = split(name, 'x');
  if (parts.size() != 2) reject(flag, text, kExpected);
  const auto width = number<int>(parts[0]);
  const auto height = number<int>(parts[1]);
  if (!width || !height || *width <= 0 || *height <= 0) reject(flag, text, kExpected);
  return {*width, *height};
}

double parse_duration(const std::string& flag, const std::string& text) {
  static constexpr std::string_view kExpected = "a time above 0 such as 90s, 2m or 1.5h";
  double unit = 1;
  std::string_view digits = text;
  if (!digits.empty()) {
    const std::size_t which = std::string_view("smh").find(digits.back());
    if (which != std::string_view::npos) {
      unit = which == 0 ? 1 : which == 1 ? 60 : 3600;
      digits.remove_suffix(1);
    }
  }
  const auto value = number<double>(digits);
  if (!value || !std::isfinite(*value) || *value <= 0) reject(flag, text, kExpected);
  return *value * unit;
}

Crop parse_crop(const std::string& flag, const std::string& text) {
  static constexpr std::string_view kExpected =
      "x,y,width,height in pixels, with width and height above 0";
  const auto parts = split(text, ',');
  if (parts.size() != 4) reject(flag, text, kExpected);
  int values[4] = {};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = number<int>(parts[i]);
    if (!value || *value < (i < 2 ? 0 : 1)) reject(flag, text, kExpected);
    values[i] = *value;
  }
  return {values[0], values[1], values[2], values[3]};
}

SampleName parse_sample(const std::string& flag, const std::string& text) {
  static constexpr std::string_view kExpected =
      "x,y,k: a pixel from the top left and a sample index, from 0";
  const auto parts = split(text, ',');
  if (parts.size() != 3) reject(flag, text, kExpected);
  const auto x = number<int>(parts[0]), y = number<int>(parts[1]);
  const auto sample = number<std::uint32_t>(parts[2]);
  if (!x || !y || !sample || *x < 0 || *y < 0) reject(flag, text, kExpected);
  return {*x, *y, *sample};
}

std::vector<int> parse_counts(const std::string& flag, const std::string& text) {
  if (text == "0") return {};
  std::vector<int> counts;
  for (const std::string_view part : split(text, ',')) {
    const auto count = number<int>(part);
    if (!count || *count <= 0) {
      reject(flag, text, "sample counts above 0 such as 1000 or 10,200,1000 (or 0: no limit)");
    }
    counts.push_back(*count);
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

KernelKind parse_kernel(const std::string& flag, const std::string& text) {
  if (text == "auto") return KernelKind::Auto;
  if (text == "float") return best_kernel(Precision::Float);
  if (text == "double") return best_kernel(Precision::Double);
  std::string supported = "auto, float, double";
  for (const KernelKind kind : kKernels) {
    if (!kernel_supported(kind)) continue;
    if (text == kernel_name(kind)) return kind;
    supported += fmt::format(", {}", kernel_name(kind));
  }
  reject(flag, text, fmt::format("a kernel that this processor runs: {}", supported));
}

std::pair<std::string, std::string> parse_definition(const std::string& flag,
                                                     const std::string& text) {
  const std::size_t equals = text.find('=');
  if (text.empty() || text[0] != '/' || equals == text.npos) {
    reject(flag, text, "/json/pointer=value such as /render/maxDepth=8");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace lightbench
