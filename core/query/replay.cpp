#include "core/query/replay.h"

#include <fmt/format.h>

namespace lightbench {
namespace {

std::string shell_word(const std::string& text) {
  static constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += "'\\''";
    } else {
      word += c;
    }
  }
  return word + "'";
}

}  // namespace

std::string replay_command(const std::string& file, const RenderSettings& settings,
                           const std::string& kernel, const SampleName& name,
                           const std::vector<std::string>& definitions) {
  std::string command = "lightbench render " + shell_word(file);
  for (const std::string& definition : definitions) command += " --set " + shell_word(definition);
  return command + fmt::format(
                       " --resolution {}x{} --depth {} --seed {} --kernel {} "
                       "--debug-sample {},{},{}",
                       settings.width, settings.height, settings.max_depth, settings.seed, kernel,
                       name.x, name.y, name.sample);
}

}  // namespace lightbench
