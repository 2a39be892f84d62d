#pragma once
// Numbers as people read them, in the window and on the terminal.

#include <cstdint>
#include <string>

namespace lightbench {

/// With a metric prefix: 950 rays/s, 12.3 k, 4.56 M, 7.89 Grays/s.
std::string format_count(double value, const std::string& unit = "");
/// 12.3 ms, 0.82 s, 12.3 s, 3:05, 2:03:05; - if negative or not finite.
std::string format_duration(double seconds);
/// 512 B, 12.3 KiB, 4.56 MiB.
std::string format_bytes(std::uint64_t bytes);
/// 1 234 567: all digits, in groups.
std::string format_integer(std::int64_t value);

}  // namespace lightbench
