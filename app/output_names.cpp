#include "app/output_names.h"

#include <fmt/format.h>
#include <unistd.h>

#include <map>

#include "core/error.h"
#include "core/film/image_file.h"

namespace lightbench {

std::filesystem::path output_name(const std::string& pattern, const OutputFields& fields) {
  const std::map<std::string, std::string> values = {
      {"scene", fields.scene},
      {"spp", std::to_string(fields.spp)},
      {"seed", std::to_string(fields.seed)},
      {"width", std::to_string(fields.width)},
      {"height", std::to_string(fields.height)},
      {"time", fields.time},
  };
  const auto reject = [&](const std::string& what) {
    return Error(ErrorKind::Usage,
                 fmt::format("-o '{}': {}; expected fields {{scene}} {{spp}} {{seed}} {{width}} "
                             "{{height}} {{time}}",
                             pattern, what));
  };
  std::string name;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const char c = pattern[i];
    if (c != '{' && c != '}') {
      name += c;
    } else if (i + 1 < pattern.size() && pattern[i + 1] == c) {
      name += c;
      ++i;
    } else {
      const std::size_t end = c == '{' ? pattern.find('}', i) : pattern.npos;
      if (end == pattern.npos) throw reject(fmt::format("a single '{}'", c));
      const std::string field = pattern.substr(i + 1, end - i - 1);
      const auto value = values.find(field);
      if (value == values.end()) throw reject(fmt::format("unknown field {{{}}}", field));
      name += value->second;
      i = end;
    }
  }
  return name;
}

std::filesystem::path partial_name(const std::filesystem::path& name) {
  std::filesystem::path partial = name;
  partial.replace_extension(".partial" + name.extension().string());
  return partial;
}

void check_writable(const std::filesystem::path& name) {
  namespace fs = std::filesystem;
  const auto reject = [&](const std::string& what) {
    return Error(ErrorKind::Output, fmt::format("{}: {}", name.string(), what));
  };
  std::error_code ignored;
  if (fs::is_directory(name, ignored)) throw reject("is a folder, expected a file name");
  fs::path folder = fs::absolute(name).parent_path();
  while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
  if (!fs::is_directory(folder, ignored)) {
    throw reject(fmt::format("cannot be written, {} is not a folder", folder.string()));
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw reject(fmt::format("cannot be written, no permission in {}", folder.string()));
  }
}

void check_outputs(const std::vector<std::string>& patterns, const std::vector<int>& counts,
                   OutputFields fields) {
  std::map<std::filesystem::path, std::string> seen;
  for (const int count : counts) {
    fields.spp = static_cast<std::uint32_t>(count);
    for (const std::string& pattern : patterns) {
      const std::filesystem::path name = output_name(pattern, fields).lexically_normal();
      check_image_name(name);
      const auto [other, is_new] = seen.emplace(name, pattern);
      if (!is_new) {
        throw Error(
            ErrorKind::Usage,
            other->second == pattern
                ? fmt::format("-o '{}': several sample counts need {{spp}} in the name", pattern)
                : fmt::format("-o '{}': the same file as -o '{}'", pattern, other->second));
      }
      check_writable(name);
    }
  }
}

}  // namespace lightbench
