#include "core/format.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace lightbench {
namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, args...);
  return text.data();
}

std::string scaled(double value, double base, const std::array<const char*, 5>& prefixes,
                   const std::string& unit) {
  std::size_t prefix = 0;
  int decimals = 0;
  // What would be rounded to 1000 k is 1 M.
  while (std::abs(value) >= base - 0.5 && prefix + 1 < prefixes.size()) {
    value /= base;
    ++prefix;
    decimals = std::abs(value) < 9.995 ? 2 : (std::abs(value) < 99.95 ? 1 : 0);
  }
  const std::string name = prefixes[prefix] + unit;
  return print("%.*f", decimals, value) + (name.empty() ? "" : " " + name);
}

}  // namespace

std::string format_count(double value, const std::string& unit) {
  return scaled(value, 1000, {"", "k", "M", "G", "T"}, unit);
}

std::string format_bytes(std::uint64_t bytes) {
  return scaled(static_cast<double>(bytes), 1024, {"", "Ki", "Mi", "Gi", "Ti"}, "B");
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "-";
  if (seconds < 0.09995) return print("%.1f ms", 1000 * seconds);
  if (seconds < 9.995) return print("%.2f s", seconds);
  if (seconds < 59.95) return print("%.1f s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 3600) return print("%ld:%02ld", whole / 60, whole % 60);
  return print("%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string format_integer(std::int64_t value) {
  std::string digits = std::to_string(value);
  const std::size_t first = value < 0 ? 1 : 0;
  for (std::size_t i = digits.size(); i > first + 3;) {
    i -= 3;
    digits.insert(i, 1, ' ');
  }
  return digits;
}

}  // namespace lightbench
