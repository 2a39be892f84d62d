#include <cstddef>

#include "core/scene/json_write.h"

namespace lightbench {
namespace {

constexpr std::size_t kLineWidth = 100;

class Formatter {
 public:
  std::string text;

  void append(const OrderedJson& value, std::size_t indent, std::size_t used) {
    if (value.is_primitive() || fits(value, kLineWidth - std::min(used, kLineWidth))) {
      append_flat(value);
      return;
    }
    const bool object = value.is_object();
    text += object ? '{' : '[';
    const char* separator = "\n";
    for (const auto& [key, element] : value.items()) {
      text += separator;
      separator = ",\n";
      text.append(indent + 2, ' ');
      const std::size_t line_start = text.size();
      if (object) text += OrderedJson(key).dump() + ": ";
      append(element, indent + 2, indent + 2 + text.size() - line_start);
    }
    text += '\n';
    text.append(indent, ' ');
    text += object ? '}' : ']';
  }

 private:
  void append_flat(const OrderedJson& value) {
    if (value.is_primitive()) {
      text += value.dump();
      return;
    }
    const bool object = value.is_object();
    text += object ? '{' : '[';
    const char* separator = "";
    for (const auto& [key, element] : value.items()) {
      text += separator;
      separator = ", ";
      if (object) text += OrderedJson(key).dump() + ": ";
      append_flat(element);
    }
    text += object ? '}' : ']';
  }

  // Formats into a scratch copy only what could fit: an element takes at least two characters.
  [[nodiscard]] bool fits(const OrderedJson& value, std::size_t width) const {
    if (value.size() * 2 > width) return false;
    for (const auto& element : value)
      if (element.is_structured() && !fits(element, width)) return false;
    Formatter flat;
    flat.append_flat(value);
    return flat.text.size() < width;
  }
};

}  // namespace

std::string format_json(const OrderedJson& document) {
  Formatter formatter;
  formatter.append(document, 0, 0);
  return formatter.text + "\n";
}

}  // namespace lightbench
