#pragma once
// What is inside the solids of glass through which lights are sampled.

#include <vector>

#include "core/scene/bounds.h"
#include "core/scene/scene.h"

namespace lightbench {

/// Clear: nothing reaches in. Hollow: something is wholly inside, so light hardly ever passes
/// through glass alone.
enum class Interior { Clear, Crowded, Hollow };

/// Smooth glass of one colour, denser than what is around it.
bool is_clear_glass(const Material& m);

/// The boxes of a scene's objects, in world space. Of a scene without spheres and boxes of clear
/// glass none are made.
class ObjectBoxes {
 public:
  explicit ObjectBoxes(const Scene& scene);
  /// Of the object with that index. Judged by boxes, so that a solid which nothing reaches into may
  /// be called crowded.
  [[nodiscard]] Interior interior(std::size_t object) const;
  /// Whether any other object reaches before the plane through `origin` whose unit normal is n.
  [[nodiscard]] bool any_before(std::size_t object, const glm::dvec3& n,
                                const glm::dvec3& origin) const;

 private:
  const Scene& scene_;
  std::vector<Bounds> boxes_;
};

}  // namespace lightbench
