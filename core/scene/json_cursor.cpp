#include "core/scene/json_cursor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/scene/suggest.h"

namespace lightbench {
namespace {

constexpr std::size_t kShownCharacters = 40;

// RFC 6901: ~ and / inside a key are written ~0 and ~1.
std::string escaped(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

// Replaces what is not UTF-8 and escapes what is not printable, so a message stays one line.
std::string dump(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string in_quotes(std::string_view word) { return dump(Json(std::string(word))); }

std::string shortened(std::string text) {
  if (text.size() <= kShownCharacters) return text;
  std::size_t end = kShownCharacters;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end) + "...";
}

}  // namespace

std::string describe(const Json& value) {
  if (value.is_object()) return "an object";
  if (!value.is_array()) return shortened(dump(value));
  const bool scalars = std::all_of(value.begin(), value.end(),
                                   [](const Json& element) { return element.is_primitive(); });
  if (value.size() <= 4 && scalars) return shortened(dump(value));
  return "an array of " + std::to_string(value.size()) +
         (value.size() == 1 ? " element" : " elements");
}

std::string JsonCursor::pointer() const {
  if (parent_ == nullptr) return {};
  const std::string step = key_.data() != nullptr ? escaped(key_) : std::to_string(index_);
  return parent_->pointer() + "/" + step;
}

void JsonCursor::fail(const std::string& message) const {
  const std::string where = pointer();
  throw Error(ErrorKind::Scene, where.empty() ? message : where + ": " + message);
}

void JsonCursor::expected(const std::string& what) const {
  fail("expected " + what + ", got " + describe(*value_));
}

void JsonCursor::unknown_word(const std::string& word,
                              const std::vector<std::string_view>& known) const {
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (i > 0) list += i + 1 < known.size() ? ", " : " or ";
    list += known[i];
  }
  fail("expected " + list + ", got " + describe(*value_) + did_you_mean(word, known));
}

double JsonCursor::number_in(double low, double high, const std::string& what) const {
  if (!value_->is_number()) expected(what);
  const auto number = value_->get<double>();
  if (!(number >= low && number <= high) || number != std::floor(number)) expected(what);
  return number;
}

void JsonCursor::read(double& out) const {
  if (!value_->is_number()) expected("a number");
  out = value_->get<double>();
}

void JsonCursor::read(int& out) const {
  constexpr auto kMin = static_cast<double>(std::numeric_limits<int>::min());
  constexpr auto kMax = static_cast<double>(std::numeric_limits<int>::max());
  const bool huge = value_->is_number() && std::abs(value_->get<double>()) > kMax;
  out =
      static_cast<int>(number_in(kMin, kMax, huge ? "an integer below 2147483648" : "an integer"));
}

void JsonCursor::read(std::uint32_t& out) const {
  constexpr auto kMax = static_cast<double>(std::numeric_limits<std::uint32_t>::max());
  out = static_cast<std::uint32_t>(number_in(0, kMax, "an integer from 0 to 4294967295"));
}

void JsonCursor::read(bool& out) const {
  if (!value_->is_boolean()) expected("true or false");
  out = value_->get<bool>();
}

void JsonCursor::read(std::string& out) const {
  if (!value_->is_string()) expected("a string");
  out = value_->get<std::string>();
}

void JsonCursor::read(glm::dvec2& out) const {
  if (!value_->is_array() || value_->size() != 2) expected("an array of 2 numbers");
  for (int i = 0; i < 2; ++i) element(static_cast<std::size_t>(i)).read(out[i]);
}

void JsonCursor::read(glm::dvec3& out) const {
  if (!value_->is_array() || value_->size() != 3) expected("an array of 3 numbers");
  for (int i = 0; i < 3; ++i) element(static_cast<std::size_t>(i)).read(out[i]);
}

void JsonCursor::read(std::array<std::uint32_t, 3>& out) const {
  if (!value_->is_array() || value_->size() != 3) expected("an array of 3 vertex indices");
  for (std::size_t i = 0; i < 3; ++i) element(i).read(out[i]);
}

void JsonCursor::expect_array() const {
  if (!value_->is_array()) expected("an array");
}

void JsonCursor::expect_array(std::size_t size) const {
  if (!value_->is_array() || value_->size() != size)
    expected("an array of " + std::to_string(size) + " elements");
}

JsonObject::JsonObject(const JsonCursor& cursor) : cursor_(cursor) {
  if (!cursor.value().is_object()) cursor.expected("an object");
}

bool JsonObject::has(std::string_view key) {
  if (std::find(asked_.begin(), asked_.end(), key) == asked_.end()) asked_.push_back(key);
  return cursor_.value().contains(key);
}

JsonCursor JsonObject::member(std::string_view key) {
  if (!has(key)) cursor_.fail("expected a key " + in_quotes(key));
  return {cursor_.value().at(key), cursor_, key};
}

void JsonObject::finish() const {
  for (const auto& [key, value] : cursor_.value().items()) {
    if (std::find(asked_.begin(), asked_.end(), key) == asked_.end())
      cursor_.fail("unknown key " + in_quotes(key) + did_you_mean(key, asked_));
  }
}

}  // namespace lightbench
