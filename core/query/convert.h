#pragma once
// Between scene units and render space, without loss: a render-space point far from the origin of
// the scene becomes a double and a remainder.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/compile/parts.h"
#include "core/error.h"

namespace lightbench {

inline glm::dvec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }
inline void put(const glm::dvec3& v, double (&out)[3]) {
  for (int k = 0; k < 3; ++k) out[k] = v[k];
}

/// a + b = sum + error exactly (Knuth's TwoSum).
struct ExactSum {
  double sum, error;
};
inline ExactSum exact_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

inline glm::dvec3 to_render(const RenderSpace& space, const glm::dvec3& p,
                            const glm::dvec3& remainder) {
  glm::dvec3 q;
  for (int k = 0; k < 3; ++k) {
    const ExactSum s = exact_sum(p[k], -space.center[k]);
    q[k] = (s.sum + (s.error + remainder[k])) * space.scale;
  }
  return q;
}

inline void to_scene(const RenderSpace& space, const glm::dvec3& q, glm::dvec3& p,
                     glm::dvec3& remainder) {
  for (int k = 0; k < 3; ++k) {
    const ExactSum s = exact_sum(q[k] / space.scale, space.center[k]);
    p[k] = s.sum;
    remainder[k] = s.error;
  }
}

/// Length of v, also where the squares of its components overflow or vanish.
inline double safe_length(const glm::dvec3& v) {
  const double m = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return m * glm::length(v / m);
}

/// A scene's time in [0,1] over the shutter.
template <class T>
double shutter_share(const GeometryPart<T>& geometry, double time) {
  const double shutter = geometry.reach->shutter_close - geometry.reach->shutter_open;
  return shutter > 0 ? std::clamp((time - geometry.reach->shutter_open) / shutter, 0.0, 1.0) : 0.0;
}
template <class T>
double shutter_time(const GeometryPart<T>& geometry, double share) {
  return geometry.reach->shutter_open +
         share * (geometry.reach->shutter_close - geometry.reach->shutter_open);
}

/// Slot of a mesh's triangle, or triangle of its slot; the object need not be a mesh.
template <class T>
const MeshPart<T>* mesh_part(const KernelParts<T>& parts, std::uint32_t primitive) {
  const GeometryPart<T>& g = *parts.geometry;
  if (g.kind[primitive] != static_cast<std::uint32_t>(PrimitiveKind::Mesh)) return nullptr;
  return g.meshes[static_cast<std::size_t>(g.rows[g.row[primitive] + kMeshRow])].get();
}

inline void check_lengths(std::size_t in, std::size_t out) {
  if (in != out) throw Error(ErrorKind::Internal, "query: as many answers as questions expected");
}

/// Puts `in` through `convert`, the kernel's `ask` and `deliver` in parts that stay in the cache.
template <class Question, class Answer, class In, class Convert, class Ask, class Deliver>
void ask_in_parts(std::span<const In> in, Convert convert, Ask ask, Deliver deliver) {
  constexpr std::size_t kPart = 128;
  std::array<Question, kPart> questions;
  std::array<Answer, kPart> answers;
  for (std::size_t begin = 0; begin < in.size(); begin += kPart) {
    const std::size_t n = std::min(kPart, in.size() - begin);
    for (std::size_t k = 0; k < n; ++k) questions[k] = convert(in[begin + k]);
    ask(std::span<const Question>(questions.data(), n), std::span<Answer>(answers.data(), n));
    for (std::size_t k = 0; k < n; ++k) deliver(begin + k, answers[k]);
  }
}

}  // namespace lightbench
