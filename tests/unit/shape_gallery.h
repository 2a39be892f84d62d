#pragma once
// One of each shape, awkwardly placed and turned, with the transforms that the shape tests apply.

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace lightbench {

struct NamedShape {
  std::string name;
  Shape shape;
  bool convex;  ///< a solid that a ray enters once
  friend void PrintTo(const NamedShape& s, std::ostream* out) { *out << s.name; }
};

const std::vector<NamedShape>& shape_gallery();

/// The mesh of the gallery's MeshShape: a closed, faceted, slightly bumpy ball with uvs.
std::shared_ptr<const Mesh> gallery_mesh();

struct NamedTransform {
  std::string name;
  Transform transform;
};
const std::vector<NamedTransform>& gallery_transforms();

/// The object alone, in a scene that compiles.
Scene scene_of(const Shape& shape, const Transform& transform);

}  // namespace lightbench
