#pragma once
// Numbers as people read them.

#include <cstdint>
#include <string>

namespace lightbench::ui {

/// 950, 12.3 k, 4.56 M, 7.89 G.
std::string format_count(double value);
/// 12.3 ms, 0.82 s, 12.3 s, 3:05, 2:03:05.
std::string format_duration(double seconds);
/// 512 B, 12.3 KB, 4.6 MB (powers of 1024).
std::string format_bytes(std::uint64_t bytes);
/// 1 234 567, with thin groups as statistics panels show whole numbers.
std::string format_integer(std::int64_t value);

}  // namespace lightbench::ui
