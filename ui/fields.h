#pragma once
// Rows of a panel: a label on the left, a widget that fills the rest, units inside the widget. Each
// returns true while the user changes the value. Colours are shown in sRGB and stored linear.

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace lightbench::ui {

/// How a number is dragged and printed. Typed values are held within min..max as well.
struct NumberStyle {
  double speed = 0.01;  ///< change per pixel
  double min = -1e12;
  double max = 1e12;
  const char* format = "%.5g";
  bool logarithmic = false;
  const char* tip = nullptr;
};

bool number_field(const char* label, double& value, const NumberStyle& style = {});
/// Like number_field, as a slider over min..max.
bool slider_field(const char* label, double& value, const NumberStyle& style);
bool integer_field(const char* label, int& value, int min, int max, const char* format = "%d",
                   const char* tip = nullptr);
/// `integer_field` for seeds: any 32-bit value.
bool seed_field(const char* label, std::uint32_t& value);
bool vector_field(const char* label, glm::dvec3& value, const NumberStyle& style = {});
bool color_field(const char* label, glm::dvec3& linear, const char* tip = nullptr);
bool toggle_field(const char* label, bool& value, const char* tip = nullptr);
/// Index into `names`.
bool choice_field(const char* label, int& index, const std::vector<const char*>& names,
                  const char* tip = nullptr);
/// Index into `names`, or kNone shown as `none`; without `none` there is always one.
bool reference_field(const char* label, int& index, const std::vector<std::string>& names,
                     const char* none = nullptr);
/// True once, when the user has finished typing; `value` is unchanged until then.
bool text_field(const char* label, std::string& value, const char* hint = "");

/// The same over the whole width, without a label on screen.
bool wide_text_field(const char* label, std::string& value, const char* hint = "");

/// Value that cannot be edited.
void value_row(const char* label, const std::string& value);
/// `text`, or as much of it as fits `width` with dots at its end.
std::string elided(const std::string& text, float width);
/// One line, cut off with dots where the panel ends.
void elided_text(const std::string& text);
/// Muted paragraph that wraps.
void note(const char* text);
/// A titled group of rows, open at first. True if open.
bool section(const char* title);
/// Icon with a tooltip, as small as a row. True when clicked.
bool icon_button(const char* icon, const char* label, bool enabled = true);
/// Tooltip for the widget drawn last; nothing if null.
void tip_for_last(const char* tip);

/// The enum as a choice over `names`, in the order of its values.
template <class Enum>
bool enum_field(const char* label, Enum& value, const std::vector<const char*>& names,
                const char* tip = nullptr) {
  int index = static_cast<int>(value);
  const bool changed = choice_field(label, index, names, tip);
  if (changed) value = static_cast<Enum>(index);
  return changed;
}

}  // namespace lightbench::ui
