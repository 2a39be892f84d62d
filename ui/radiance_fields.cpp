#include "ui/radiance_fields.h"

#include <algorithm>

#include "ui/fields.h"

namespace lightbench::ui {

bool radiance_fields(const char* label, glm::dvec3& color, double& strength) {
  const double factor = std::max({1.0, color.x, color.y, color.z});
  glm::dvec3 shown_color = color / factor;
  double shown_strength = strength * factor;
  bool changed = color_field(label, shown_color, "Black gives no light");
  changed = number_field("Strength", shown_strength,
                         {.speed = std::max(0.005, 0.01 * shown_strength),
                          .min = 0,
                          .max = 1e9,
                          .format = "%.4g",
                          .tip = "Radiance = colour x strength"}) ||
            changed;
  if (changed) {
    color = shown_color;
    strength = shown_strength;
  }
  return changed;
}

}  // namespace lightbench::ui
