#include "core/scene/override.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "core/scene/suggest.h"

namespace lightbench {
namespace {

[[noreturn]] void fail(const Override& change, const std::string& message) {
  throw Error(ErrorKind::Scene, change.pointer + ": " + message);
}

/// The steps of an RFC 6901 pointer, ~1 and ~0 decoded.
std::vector<std::string> steps_of(const Override& change) {
  const std::string& pointer = change.pointer;
  if (pointer.size() < 2 || pointer[0] != '/')
    fail(change, "expected a JSON pointer such as /render/spp");
  std::vector<std::string> steps;
  for (std::size_t i = 0; i < pointer.size(); ++i) {
    if (pointer[i] == '/') {
      steps.emplace_back();
    } else if (pointer[i] != '~') {
      steps.back() += pointer[i];
    } else if (++i < pointer.size() && (pointer[i] == '0' || pointer[i] == '1')) {
      steps.back() += pointer[i] == '0' ? '~' : '/';
    } else {
      fail(change, "expected ~0 or ~1 after ~ in a JSON pointer");
    }
  }
  return steps;
}

bool is_index(const std::string& step) {
  return !step.empty() && step.size() < 10 &&
         std::all_of(step.begin(), step.end(), [](unsigned char c) { return std::isdigit(c); });
}

Json& element(Json& array, const std::string& step, const Override& change) {
  if (is_index(step) && std::stoul(step) < array.size()) return array[std::stoul(step)];
  std::vector<std::string_view> names;
  for (Json& candidate : array) {
    const auto name = candidate.is_object() ? candidate.find("name") : candidate.end();
    if (!candidate.is_object() || name == candidate.end() || !name->is_string()) continue;
    if (name->get_ref<const std::string&>() == step) return candidate;
    names.emplace_back(name->get_ref<const std::string&>());
  }
  fail(change, "expected an element below " + std::to_string(array.size()) + " or its name, got " +
                   describe(Json(step)) + did_you_mean(step, names));
}

/// What is not JSON is a bare word: -D /display/toneMap=aces.
Json value_of(const std::string& text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

}  // namespace

void apply_override(Json& document, const Override& change) {
  Json* at = &document;
  for (const std::string& step : steps_of(change)) {
    if (at->is_null()) *at = Json::object();  // a member that was missing until now
    if (at->is_object()) {
      at = &(*at)[step];
    } else if (at->is_array()) {
      at = &element(*at, step, change);
    } else {
      fail(change, "expected an object or an array above " + describe(Json(step)) + ", got " +
                       describe(*at));
    }
  }
  *at = value_of(change.value);
}

}  // namespace lightbench
