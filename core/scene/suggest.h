#pragma once
// Help for misspelt words in error messages.

#include <string>
#include <string_view>
#include <vector>

namespace lightbench {

/// ", did you mean \"radius\"?" if one of `candidates` is close to `word`, else the empty string.
std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace lightbench
