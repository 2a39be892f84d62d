#include "core/compile/glass_interior.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <variant>

namespace lightbench {
namespace {

using glm::dvec3;

/// Whether the box reaches into the solid that fills `body`; one that only touches it does not.
bool reaches(const Bounds& box, const Bounds& body, bool still_ball) {
  const dvec3 slack = 1e-9 * body.size();
  if (glm::any(glm::greaterThanEqual(box.min, body.max - slack)) ||
      glm::any(glm::lessThanEqual(box.max, body.min + slack))) {
    return false;
  }
  if (!still_ball) return true;
  const dvec3 c = body.center(), nearest = glm::clamp(c, box.min, box.max);
  const double radius = 0.5 * body.size().x;
  return glm::distance(c, nearest) < radius * (1 - 1e-9);
}

bool within(const Bounds& box, const Bounds& other) {
  return glm::all(glm::greaterThanEqual(box.min, other.min)) &&
         glm::all(glm::lessThanEqual(box.max, other.max));
}

}  // namespace

bool is_clear_glass(const Material& m) {
  return m.kind == MaterialKind::Dielectric && m.ior > 1 && m.base_color_texture == kNone;
}

ObjectBoxes::ObjectBoxes(const Scene& scene) : scene_(scene) {
  const auto& objects = scene.objects;
  const bool needed = std::any_of(objects.begin(), objects.end(), [&](const Object& o) {
    const bool may_be_lens =
        std::holds_alternative<SphereShape>(o.shape) || std::holds_alternative<BoxShape>(o.shape);
    // The boundary of a medium needs no material.
    return may_be_lens && o.visible && o.material != kNone &&
           is_clear_glass(scene.materials[static_cast<std::size_t>(o.material)]);
  });
  if (!needed) return;
  const std::vector<Bounds> meshes = all_mesh_bounds(scene);
  boxes_.reserve(scene.objects.size());
  for (const Object& o : scene.objects)
    boxes_.push_back(o.visible ? object_bounds(o, scene.camera, meshes) : Bounds{});
}

Interior ObjectBoxes::interior(std::size_t object) const {
  const Object& o = scene_.objects[object];
  const auto* ball = std::get_if<SphereShape>(&o.shape);
  const bool still_ball = ball != nullptr && ball->motion == dvec3(0);
  bool crowded = o.medium != kNone;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (i == object || boxes_[i].empty()) continue;
    if (!reaches(boxes_[i], boxes_[object], still_ball)) continue;
    if (within(boxes_[i], boxes_[object])) return Interior::Hollow;
    crowded = true;
  }
  return crowded ? Interior::Crowded : Interior::Clear;
}

bool ObjectBoxes::any_before(std::size_t object, const dvec3& n, const dvec3& origin) const {
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (i == object || boxes_[i].empty()) continue;
    const dvec3 farthest = glm::mix(boxes_[i].min, boxes_[i].max, glm::greaterThan(n, dvec3(0)));
    if (glm::dot(n, farthest - origin) > 1e-9 * glm::length(boxes_[object].size())) return true;
  }
  return false;
}

}  // namespace lightbench
