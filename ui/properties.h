#pragma once
// Editors of one item each, drawn into the properties panel. Split by kind so that each fits a
// page.

#include "ui/workbench.h"

namespace lightbench::ui {

void draw_object_properties(Workbench& bench, int index);
void draw_material_properties(Workbench& bench, int index);
void draw_texture_properties(Workbench& bench, int index);
void draw_medium_properties(Workbench& bench, int index);

/// Rows for the parameters of a shape; `step` is what one mouse pixel changes a length by. To add a
/// shape, add an overload in ui/shape_fields.cpp.
void draw_shape_fields(Workbench& bench, Shape& shape, double step);

/// Names of a list, for reference_field.
template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const T& item : list) names.push_back(item.name);
  return names;
}

}  // namespace lightbench::ui
