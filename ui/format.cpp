#include "ui/format.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace lightbench::ui {
namespace {

template <class... Args>
std::string print(const char* format, Args... args) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, args...);
  return text.data();
}

std::string scaled(double value, double base, const std::array<const char*, 5>& units) {
  std::size_t unit = 0;
  while (std::abs(value) >= base && unit + 1 < units.size()) {
    value /= base;
    ++unit;
  }
  const int decimals = unit == 0 || value >= 100 ? 0 : (value >= 10 ? 1 : 2);
  std::string text = print("%.*f", decimals, value);
  if (units[unit][0] != '\0') text += std::string(" ") + units[unit];
  return text;
}

}  // namespace

std::string format_count(double value) { return scaled(value, 1000, {"", "k", "M", "G", "T"}); }

std::string format_bytes(std::uint64_t bytes) {
  return scaled(static_cast<double>(bytes), 1024, {"B", "KB", "MB", "GB", "TB"});
}

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "-";
  if (seconds < 0.1) return print("%.1f ms", 1000 * seconds);
  if (seconds < 10) return print("%.2f s", seconds);
  if (seconds < 60) return print("%.1f s", seconds);
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

}  // namespace lightbench::ui
