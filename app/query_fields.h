#pragma once
// The fields of one line of `lightbench query`, a JSON object, and of the lines that answer it.

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace lightbench {

/// One question. Its functions throw Error{Scene} that names the input, the line and the field.
class QueryFields {
 public:
  /// `where` is the input and the line, for messages.
  QueryFields(std::string where, const std::string& line);

  [[nodiscard]] bool has(const char* field) const { return json_.contains(field); }
  double number(const char* field, double otherwise);
  /// In [0,1).
  double unit(const char* field, double otherwise);
  /// A whole number in [0, end).
  int index(const char* field, int end);
  glm::dvec3 point(const char* field);
  /// Three numbers that are not all zero.
  glm::dvec3 direction(const char* field);
  glm::dvec3 direction(const char* field, const glm::dvec3& otherwise);
  /// As many numbers in [0,1) as `least` to `most`.
  std::vector<double> units(const char* field, std::size_t least, std::size_t most);
  /// A name of `names`; gives its index.
  int name(const char* field, const std::vector<std::string>& names, const char* what);
  bool boolean(const char* field, bool otherwise);
  /// Says that the line may have this field, which is not read now.
  void optional(const char* field) { known_.emplace_back(field); }
  /// A nested object.
  QueryFields object(const char* field);

  /// To be called when all known fields have been read: any other is an error.
  void expect_no_more() const;
  [[noreturn]] void reject(const char* field, const std::string& expected) const;

 private:
  QueryFields(std::string where, nlohmann::json json);
  const nlohmann::json& required(const char* field, const char* expected);
  std::vector<double> numbers(const char* field, std::size_t least, std::size_t most,
                              const char* expected);

  std::string where_;
  nlohmann::json json_;
  std::vector<std::string> known_;
};

/// A JSON object written field by field, numbers with the 17 digits that carry a double exactly.
class AnswerLine {
 public:
  AnswerLine& add(const char* field, double value);
  AnswerLine& add(const char* field, int value);
  AnswerLine& add(const char* field, bool value);
  AnswerLine& add(const char* field, const glm::dvec3& value);
  AnswerLine& add(const char* field, double a, double b);
  AnswerLine& add(const char* field, const std::string& value);
  AnswerLine& add(const char* field, const char* value) = delete;
  AnswerLine& add(const char* field, const std::vector<AnswerLine>& values);
  [[nodiscard]] std::string text() const { return "{" + fields_ + "}"; }

 private:
  AnswerLine& raw(const char* field, std::string_view json);
  std::string fields_;
};

}  // namespace lightbench
