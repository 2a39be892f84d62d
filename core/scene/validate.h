#pragma once
// The vocabulary of validate(): a place in the scene and the checks a number can fail there.

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "core/scene/scene.h"

namespace lightbench {

/// A field, spelt as its JSON pointer only when something is wrong.
struct Place {
  const char* list = "";  ///< "/objects", or "/camera" with no index
  std::size_t index = kNoIndex;
  const char* field = "";  ///< "/radius"
  static constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

  [[nodiscard]] Place operator/(const char* name) const { return {list, index, name}; }
  [[nodiscard]] std::string pointer() const;
};

/// Lengths and coordinates stay where their squares are exact enough in float and finite in double.
inline constexpr double kLargestLength = 1e18;
inline constexpr double kSmallestLength = 1e-18;

/// Throws Error{Scene} "place: expected `what`, got `got`".
[[noreturn]] void out_of_range(const Place& place, const std::string& what, const std::string& got);
std::string to_text(double value);
std::string to_text(const glm::dvec3& value);

void check_in(const Place& place, double value, double low, double high);
void check_in(const Place& place, const glm::dvec3& value, double low, double high);
void check_at_least(const Place& place, double value, double low);  ///< finite too
void check_positive_length(const Place& place, double value);
/// A coordinate or vector whose components are finite and at most kLargestLength.
void check_point(const Place& place, const glm::dvec3& value);
/// The same, and longer than kSmallestLength.
void check_direction(const Place& place, const glm::dvec3& value);

/// Range of every parameter of a shape, and that it has an extent.
void validate_shape(const Place& place, const Shape& shape, std::size_t mesh_count);
/// True for the shapes that enclose a volume; meshes are taken at their word.
bool is_closed(const Shape& shape);
/// Indices in range, positions finite, attribute counts equal.
void validate_mesh(const Place& place, const Mesh& mesh);

}  // namespace lightbench
