#pragma once
// Whole files in and out. A file is either the old one or the new one, never half of either.

#include <filesystem>
#include <string>
#include <string_view>

namespace lightbench {

/// The bytes of a regular file. Throws Error{Scene} "name: cannot be read: why".
std::string read_file(const std::filesystem::path& file);

/// Throws as read_file would if `file` is not a regular file that can be opened.
void check_readable(const std::filesystem::path& file);

/// Writes to a new name in the same folder, flushes it to the disk, then renames it over `file` (or
/// over what a symbolic link points to). Throws Error{Output} "name: cannot be written: why" and
/// leaves nothing behind.
void replace_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace lightbench
