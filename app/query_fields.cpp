#include "app/query_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/scene/suggest.h"

namespace lightbench {
namespace {

std::string seventeen_digits(double value) {
  return std::isfinite(value) ? fmt::format("{:.17g}", value) : "null";
}

bool in_unit_interval(double value) { return value >= 0 && value < 1; }

}  // namespace

QueryFields::QueryFields(std::string where, const std::string& line) : where_(std::move(where)) {
  try {
    json_ = nlohmann::json::parse(line);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::Scene, fmt::format("{}: not JSON: {}", where_, error.what()));
  }
  if (!json_.is_object()) {
    throw Error(ErrorKind::Scene, fmt::format("{}: expected a JSON object", where_));
  }
}

QueryFields::QueryFields(std::string where, nlohmann::json json)
    : where_(std::move(where)), json_(std::move(json)) {}

void QueryFields::reject(const char* field, const std::string& expected) const {
  throw Error(ErrorKind::Scene, fmt::format("{}: \"{}\": expected {}", where_, field, expected));
}

const nlohmann::json& QueryFields::required(const char* field, const char* expected) {
  known_.emplace_back(field);
  if (!json_.contains(field)) reject(field, expected);
  return json_[field];
}

double QueryFields::number(const char* field, double otherwise) {
  known_.emplace_back(field);
  if (!has(field)) return otherwise;
  if (!json_[field].is_number()) reject(field, "a number");
  return json_[field].get<double>();
}

double QueryFields::unit(const char* field, double otherwise) {
  const double value = number(field, otherwise);
  if (!in_unit_interval(value)) reject(field, "a number from 0 to below 1");
  return value;
}

int QueryFields::index(const char* field, int end) {
  const std::string expected = fmt::format("a whole number from 0 to {}", end - 1);
  const nlohmann::json& value = required(field, expected.c_str());
  if (!value.is_number_integer() || value < 0 || value >= end) reject(field, expected);
  return value.get<int>();
}

std::vector<double> QueryFields::numbers(const char* field, std::size_t least, std::size_t most,
                                         const char* expected) {
  const nlohmann::json& value = required(field, expected);
  if (!value.is_array() || value.size() < least || value.size() > most ||
      !std::all_of(value.begin(), value.end(), [](const auto& x) { return x.is_number(); })) {
    reject(field, expected);
  }
  return value.get<std::vector<double>>();
}

glm::dvec3 QueryFields::point(const char* field) {
  const auto v = numbers(field, 3, 3, "[x, y, z]");
  return {v[0], v[1], v[2]};
}

glm::dvec3 QueryFields::direction(const char* field) {
  const glm::dvec3 d = point(field);
  if (d == glm::dvec3(0)) reject(field, "a direction that is not zero");
  return d;
}

glm::dvec3 QueryFields::direction(const char* field, const glm::dvec3& otherwise) {
  known_.emplace_back(field);
  return has(field) ? direction(field) : otherwise;
}

std::vector<double> QueryFields::units(const char* field, std::size_t least, std::size_t most) {
  const std::string expected =
      fmt::format("{} numbers from 0 to below 1",
                  least == most ? std::to_string(least) : fmt::format("{} to {}", least, most));
  auto values = numbers(field, least, most, expected.c_str());
  if (!std::all_of(values.begin(), values.end(), in_unit_interval)) reject(field, expected);
  return values;
}

int QueryFields::name(const char* field, const std::vector<std::string>& names, const char* what) {
  const std::string expected = fmt::format("the name of {}", what);
  const nlohmann::json& value = required(field, expected.c_str());
  if (!value.is_string()) reject(field, expected);
  const auto text = value.get<std::string>();
  const auto at = std::find(names.begin(), names.end(), text);
  if (at == names.end()) {
    reject(field, fmt::format("{}; there is no '{}'{}", expected, text,
                              did_you_mean(text, {names.begin(), names.end()})));
  }
  return static_cast<int>(at - names.begin());
}

bool QueryFields::boolean(const char* field, bool otherwise) {
  known_.emplace_back(field);
  if (!has(field)) return otherwise;
  if (!json_[field].is_boolean()) reject(field, "true or false");
  return json_[field].get<bool>();
}

QueryFields QueryFields::object(const char* field) {
  const nlohmann::json& value = required(field, "an object");
  if (!value.is_object()) reject(field, "an object");
  return {fmt::format("{}: \"{}\"", where_, field), value};
}

void QueryFields::expect_no_more() const {
  for (const auto& [field, value] : json_.items()) {
    if (std::find(known_.begin(), known_.end(), field) != known_.end()) continue;
    throw Error(
        ErrorKind::Scene,
        fmt::format("{}: \"{}\": unknown field{}; expected {}", where_, field,
                    did_you_mean(field, {known_.begin(), known_.end()}), fmt::join(known_, ", ")));
  }
}

AnswerLine& AnswerLine::raw(const char* field, std::string_view json) {
  fields_ += fmt::format("{}\"{}\":{}", fields_.empty() ? "" : ",", field, json);
  return *this;
}

AnswerLine& AnswerLine::add(const char* field, double value) {
  return raw(field, seventeen_digits(value));
}

AnswerLine& AnswerLine::add(const char* field, int value) {
  return raw(field, std::to_string(value));
}

AnswerLine& AnswerLine::add(const char* field, bool value) {
  return raw(field, value ? "true" : "false");
}

AnswerLine& AnswerLine::add(const char* field, const glm::dvec3& v) {
  return raw(field, fmt::format("[{},{},{}]", seventeen_digits(v.x), seventeen_digits(v.y),
                                seventeen_digits(v.z)));
}

AnswerLine& AnswerLine::add(const char* field, double a, double b) {
  return raw(field, fmt::format("[{},{}]", seventeen_digits(a), seventeen_digits(b)));
}

AnswerLine& AnswerLine::add(const char* field, const std::string& value) {
  return raw(field, nlohmann::json(value).dump());
}

AnswerLine& AnswerLine::add(const char* field, const std::vector<AnswerLine>& values) {
  std::string list;
  for (const AnswerLine& value : values) list += (list.empty() ? "" : ",") + value.text();
  return raw(field, "[" + list + "]");
}

}  // namespace lightbench
