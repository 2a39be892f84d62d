#pragma once
// What a path uses the numbers of its sampler for. What decides together shares a set of four
// dimensions, in which it is stratified together: where in the pixel and where on the lens, or
// where in the pixel and where on a light; which way a path goes on and where on a light the point
// that it comes to samples; without lights, two directions in a row.

#include "core/kernel/uses.h"
#include "core/sampling/sobol.h"

LIGHTBENCH_KERNEL_BEGIN

namespace dimension {
// Sets of a path.
inline constexpr std::uint32_t kFilter = 0;  ///< second half: the lens, or the first vertex's light
inline constexpr std::uint32_t kTime = 1;    ///< second half: that light, where there is a lens
inline constexpr std::uint32_t kFirstVertex = 3;
inline constexpr std::uint32_t kPerVertex = 3;
// Offsets within a vertex.
inline constexpr std::uint32_t kDirection = 0;  ///< second half: light of the next vertex
inline constexpr std::uint32_t kRoulette = 1;
inline constexpr std::uint32_t kDistance = 2;  ///< free flight, or the radius of a fuzzy lobe
}  // namespace dimension

/// First of the sets of vertex number `k`; 0 is where the camera ray ends.
inline Int vertex_sets(Int k) {
  return k * Int(dimension::kPerVertex) + Int(dimension::kFirstVertex);
}

inline Vec2 filter_numbers(const Sampler& sampler) {
  return sampler.first(Int(dimension::kFilter));
}
inline Vec2 lens_numbers(const Sampler& sampler) { return sampler.second(Int(dimension::kFilter)); }
/// When within the shutter.
inline Real time_number(const Sampler& sampler) { return sampler.first(Int(dimension::kTime)).x; }

/// Which light vertex `k` samples, and where on it.
inline Bits2 light_numbers(const SceneView<T>& scene, const Sampler& sampler, Int k) {
  Int set = vertex_sets(k - Int(1U)) + Int(dimension::kDirection);  // kFilter for the first
  if (uses(scene, Feature::Lens)) set = select(k == Int(0U), Int(dimension::kTime), set);
  return sampler.second_bits(set);
}

/// Where the path goes from vertex `k`.
inline Vec2 direction_numbers(const SceneView<T>& scene, const Sampler& sampler, Int k) {
  if (uses(scene, Feature::Lights))
    return sampler.first(vertex_sets(k) + Int(dimension::kDirection));
  const Mask odd = (k & Int(1U)) == Int(1U);
  return sampler.either(vertex_sets(select(odd, k - Int(1U), k)) + Int(dimension::kDirection), odd);
}

inline Real roulette_number(const Sampler& sampler, Int k) {
  return sampler.first(vertex_sets(k) + Int(dimension::kRoulette)).x;
}
/// The radius of a fuzzy lobe at vertex `k`.
inline Real fuzz_number(const Sampler& sampler, Int k) {
  return sampler.first(vertex_sets(k) + Int(dimension::kDistance)).x;
}
/// The free flight to vertex `k` through a medium; every medium has a set of its own.
inline Real flight_number(const Sampler& sampler, Int k, std::uint32_t medium) {
  return sampler.first(vertex_sets(k) + Int(dimension::kDistance + (medium << 16))).y;
}

static_assert(dimension::kFirstVertex == dimension::kPerVertex, "light_numbers() counts on it");

LIGHTBENCH_KERNEL_END
