#include <glm/vector_relational.hpp>

#include "core/scene/scene.h"

namespace lightbench {

bool emits(const Material& material) {
  return material.emissive_strength > 0 &&
         glm::any(glm::greaterThan(material.emissive, glm::dvec3(0)));
}

}  // namespace lightbench
