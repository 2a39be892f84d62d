#include "core/compile/mesh_pieces.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/scene/bounds.h"

namespace lightbench {
namespace {

/// Sets of numbers that grow together (Tarjan's union-find, with paths halved).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller root stays, so that neighbours in a file end up near each other.
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint64_t hash_of(const glm::dvec3& p) {
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(p[k] + 0.0)) * 0x9e3779b97f4a7c15U;  // -0 is 0
    hash ^= hash >> 32U;
  }
  return hash;
}

/// Joins positions that are equal, by a table of the first of each.
void join_equal(const std::vector<glm::dvec3>& positions, Sets& sets) {
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> table(std::bit_ceil(2 * positions.size()), kFree);
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    std::size_t at = hash_of(positions[i]) & mask;
    while (table[at] != kFree && positions[table[at]] != positions[i]) at = (at + 1) & mask;
    if (table[at] == kFree) {
      table[at] = i;
    } else {
      sets.join(table[at], i);
    }
  }
}

}  // namespace

double smallest_piece(const Mesh& mesh) {
  if (mesh.triangles.empty()) return std::numeric_limits<double>::infinity();
  Sets sets(mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    sets.join(t[0], t[1]);
    sets.join(t[1], t[2]);
  }
  // Looking for equal positions takes the most time, and one piece has nothing to gain.
  const std::uint32_t first = sets.root(mesh.triangles[0][0]);
  const bool whole = std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                                 [&](const auto& t) { return sets.root(t[0]) == first; });
  if (!whole) join_equal(mesh.positions, sets);
  // By root; positions of no triangle stay out.
  std::vector<Bounds> pieces(whole ? 1 : mesh.positions.size());
  for (const auto& t : mesh.triangles) {
    Bounds& piece = pieces[whole ? 0 : sets.root(t[0])];
    for (const std::uint32_t corner : t) piece.add(mesh.positions[corner]);
  }
  double smallest = std::numeric_limits<double>::infinity();
  for (const Bounds& piece : pieces) {
    if (piece.empty()) continue;
    const glm::dvec3 size = piece.size();
    const double longest = std::max({size.x, size.y, size.z});
    if (longest > 0) smallest = std::min(smallest, longest);
  }
  return smallest;
}

}  // namespace lightbench
