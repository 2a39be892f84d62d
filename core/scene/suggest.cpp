#include "core/scene/suggest.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace lightbench {
namespace {

constexpr std::size_t kLongestWord = 64;

// "base_color", "BaseColor" and "basecolor" are the same word to a person.
std::string plain(std::string_view word) {
  std::string result;
  for (const char c : word) {
    if (c != '_' && c != '-' && c != ' ')
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

// Levenshtein distance: insertions, deletions and replacements.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (word.empty() || word.size() > kLongestWord) return {};
  const std::string wanted = plain(word);
  std::string_view best;
  std::size_t best_distance =
      std::max<std::size_t>(wanted.size() / 3, 1);  // one slip in three letters
  for (const std::string_view candidate : candidates) {
    if (candidate.empty() || candidate.size() > kLongestWord) continue;
    const std::size_t distance = edit_distance(wanted, plain(candidate));
    if (distance < best_distance || (distance == best_distance && best.empty())) {
      best = candidate;
      best_distance = distance;
    }
  }
  // A word of which nothing is left is no misspelling.
  if (best.empty() || best_distance >= std::max<std::size_t>(wanted.size(), 1)) return {};
  return ", did you mean \"" + std::string(best) + "\"?";
}

}  // namespace lightbench
