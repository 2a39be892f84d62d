#pragma once
// Typed reading of a JSON document whose errors name the place. A cursor is a value plus the way to
// it; the pointer is only spelled out when something is wrong.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lightbench {

using Json = nlohmann::json;

/// A table of the words for an enumeration (core/scene/json_names.h).
template <class T, std::size_t N>
using Names = std::array<std::pair<const char*, T>, N>;

/// Refers to the value and to the cursor above it: keep both alive. Every read throws Error{Scene}
/// "/objects/3/radius: expected a number, got true".
class JsonCursor {
 public:
  explicit JsonCursor(const Json& root) : value_(&root) {}
  JsonCursor(const Json& value, const JsonCursor& parent, std::string_view key)
      : value_(&value), parent_(&parent), key_(key) {}
  JsonCursor(const Json& value, const JsonCursor& parent, std::size_t index)
      : value_(&value), parent_(&parent), index_(index) {}

  [[nodiscard]] const Json& value() const { return *value_; }
  [[nodiscard]] std::string pointer() const;
  /// "expected `what`, got ..." at this place.
  [[noreturn]] void expected(const std::string& what) const;
  /// `message` at this place.
  [[noreturn]] void fail(const std::string& message) const;

  void read(double& out) const;  ///< any JSON number; infinities cannot be written in JSON
  void read(int& out) const;     ///< 10, 10.0 and 1e1 are the same integer
  void read(std::uint32_t& out) const;
  void read(bool& out) const;
  void read(std::string& out) const;
  void read(glm::dvec2& out) const;
  void read(glm::dvec3& out) const;
  void read(std::array<std::uint32_t, 3>& out) const;

  template <class T, std::size_t N>
  void read(std::array<T, N>& out) const {
    expect_array(N);
    for (std::size_t i = 0; i < N; ++i) element(i).read(out[i]);
  }
  template <class T>
  void read(std::vector<T>& out) const {
    expect_array();
    out.resize(value_->size());
    for (std::size_t i = 0; i < out.size(); ++i) element(i).read(out[i]);
  }
  template <class T, std::size_t N>
  void read_name(const Names<T, N>& names, T& out) const {
    std::string word;
    read(word);
    std::vector<std::string_view> known;
    for (const auto& [name, value] : names) {
      if (word == name) {
        out = value;
        return;
      }
      known.emplace_back(name);
    }
    unknown_word(word, known);
  }

  /// Throws unless this is an array, of `size` elements if given.
  void expect_array() const;
  void expect_array(std::size_t size) const;
  [[nodiscard]] std::size_t size() const { return value_->size(); }
  [[nodiscard]] JsonCursor element(std::size_t index) const {
    return {(*value_)[index], *this, index};
  }

 private:
  [[nodiscard]] double number_in(double low, double high, const std::string& what) const;
  [[noreturn]] void unknown_word(const std::string& word,
                                 const std::vector<std::string_view>& known) const;

  const Json* value_;
  const JsonCursor* parent_ = nullptr;
  std::string_view key_;
  std::size_t index_ = 0;
};

/// The members of an object. Remembers which keys were asked for, so that finish() can refuse the
/// others: a misspelt key must not silently mean a default.
class JsonObject {
 public:
  /// Throws if the cursor is not at an object. The cursor must outlive this.
  explicit JsonObject(const JsonCursor& cursor);

  [[nodiscard]] bool has(std::string_view key);
  /// The member; throws if it is absent.
  [[nodiscard]] JsonCursor member(std::string_view key);

  /// Reads the member if it is there, else leaves `out`. Returns whether it was there.
  template <class T>
  bool optional(std::string_view key, T& out) {
    if (!has(key)) return false;
    member(key).read(out);
    return true;
  }
  template <class T, std::size_t N>
  bool optional_name(std::string_view key, const Names<T, N>& names, T& out) {
    if (!has(key)) return false;
    member(key).read_name(names, out);
    return true;
  }
  template <class T>
  void required(std::string_view key, T& out) {
    member(key).read(out);
  }

  /// Throws at the first key that nobody asked for.
  void finish() const;

 private:
  const JsonCursor& cursor_;
  std::vector<std::string_view> asked_;
};

/// A short single-line picture of a value for messages: "-2", "\"abc\"", "an array of 4 elements".
std::string describe(const Json& value);

}  // namespace lightbench
