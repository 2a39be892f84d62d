#include <imgui.h>

#include "core/scene/validate.h"
#include "ui/fields.h"
#include "ui/properties.h"
#include "ui/scene_edit.h"
#include "ui/theme.h"
#include "ui/widget_map.h"

namespace lightbench::ui {
namespace {

void draw_transform(Transform& transform, double step) {
  vector_field("Position", transform.translation, {.speed = step});
  vector_field("Axis", transform.axis, {.speed = 0.01, .tip = "What the object is turned about"});
  number_field("Angle", transform.degrees,
               {.speed = 0.5, .format = "%.4g\xc2\xb0", .tip = "Right-handed about the axis"});
  const glm::dvec3 before = transform.scale;
  if (vector_field("Scale", transform.scale, {.speed = 0.01})) {
    for (int c = 0; c < 3; ++c) {
      // Zero would flatten the object into nothing; the value before it stays.
      if (transform.scale[c] == 0) transform.scale[c] = before[c];
    }
  }
}

void draw_material(Workbench& bench, int index) {
  Scene& scene = bench.editor.scene;
  Object& object = scene.objects[static_cast<std::size_t>(index)];
  // An object shows a surface, a medium, or both; never neither.
  const char* none = object.medium != kNone ? "none (invisible)" : nullptr;
  reference_field("Material", object.material, names_of(scene.materials), none);
  if (is_closed(object.shape) && !scene.media.empty()) {
    const int before = object.medium;
    reference_field("Medium", object.medium, names_of(scene.media), "none");
    if (object.medium == kNone && object.material == kNone) object.medium = before;
  }
  if (object.material == kNone) return;
  const Selection material{ItemKind::Material, object.material};
  const float width = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::Button("Edit material", {width, 0})) bench.editor.selection = material;
  note_widget("Edit material");
  ImGui::SameLine();
  const int users = use_count(scene, material);
  ImGui::BeginDisabled(users < 2);
  if (ImGui::Button("Make unique", {width, 0})) make_material_unique(scene, index);
  ImGui::EndDisabled();
  note_widget("Make unique");
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled | ImGuiHoveredFlags_ForTooltip)) {
    ImGui::SetTooltip("%d object%s use%s this material", users, users == 1 ? "" : "s",
                      users == 1 ? "s" : "");
  }
}

}  // namespace

void draw_object_properties(Workbench& bench, int index) {
  Object& object = bench.editor.scene.objects[static_cast<std::size_t>(index)];
  const double step = length_step(bench.editor.scene);
  toggle_field("Visible", object.visible);
  if (section("Material")) draw_material(bench, index);
  if (section(shape_names()[object.shape.index()])) draw_shape_fields(bench, object.shape, step);
  if (section("Transform")) draw_transform(object.transform, step);
}

}  // namespace lightbench::ui
