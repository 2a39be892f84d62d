#pragma once
// Names of the pictures a render writes, from templates such as 'out/{scene}-{spp}.png'.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace lightbench {

/// What the fields of a template stand for.
struct OutputFields {
  std::string scene;  ///< name of the scene file without folder and extension
  std::uint32_t spp = 0;
  std::uint32_t seed = 0;
  int width = 0;
  int height = 0;
  std::string time;  ///< local start of the render, YYYYMMDD-HHMMSS
};

/// Replaces {scene} {spp} {seed} {width} {height} {time}; `{{` and `}}` stand for braces. Throws
/// Error{Usage} if a field is unknown or a brace is left over.
std::filesystem::path output_name(const std::string& pattern, const OutputFields& fields);

/// `out/x-200.png` -> `out/x-200.partial.png`.
std::filesystem::path partial_name(const std::filesystem::path& name);

/// All names that `patterns` give for each of `counts`. Throws, before anything is rendered, if a
/// name has no known extension, two are equal (several counts need {spp}), or one cannot be
/// written: Error{Usage} or Error{Output}.
void check_outputs(const std::vector<std::string>& patterns, const std::vector<int>& counts,
                   OutputFields fields);

/// Throws Error{Output} unless a file `name` could be created or replaced; missing folders are
/// fine.
void check_writable(const std::filesystem::path& name);

}  // namespace lightbench
