#pragma once
// Choice among many lights by what each would bring to the point: a binary tree of clusters is
// walked from the root, at each node in proportion to an estimate of the two halves (Conty Estevez
// & Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018;
// pbrt-v4 12.6.3).

#include "core/lights/chooser.h"
#include "core/sampling/hash.h"

LIGHTBENCH_KERNEL_BEGIN

/// Estimate of the irradiance that a node sheds on the point. Its row is
///   0..2 centre and 3 radius of a ball around the lights, 4 their weight, 5..7 axis, 8 cosine and
///   9 sine of a cone around their normals, 10 a quarter of the inverse of the radius.
/// As for single lights, but that the cosine at the lights is the best that cone and ball allow.
inline Real cluster_contribution(const auto& number, const Chooser& at) {
  const Vec d = Vec{number(0), number(1), number(2)} - at.p;
  const Real r = number(3), rr = r * r;
  const Real d2 = max(length_squared(d), rr * T(1e-4)), sum = d2 + rr;
  const Real distance = sqrt(d2);
  const Real receiver =
      select(looks_all_around(at), distance, clipped_height(dot(at.n, d), r, number(10)));
  const Real inverse = Real(1) / sqrt(sum);
  const Real cos_ball = distance * inverse, sin_ball = r * inverse;
  const Real cos_cone = number(8), sin_cone = number(9);
  const Real cos_both = cos_cone * cos_ball - sin_cone * sin_ball;
  const Real sin_both = sin_cone * cos_ball + cos_cone * sin_ball;
  const Real cosine = -dot(Vec{number(5), number(6), number(7)}, d) / distance;
  const Real sine = safe_sqrt(Real(1) - cosine * cosine);
  // The angle to the axis less those of the cone and the ball; all of a half turn or more is 1.
  const Mask inside = cosine >= cos_both || sin_both <= Real(0);
  const Real emitted = select(inside, Real(1), max(cosine * cos_both + sine * sin_both, Real(0)));
  return number(4) * receiver * emitted / (distance * sum);
}

/// As far down the lanes share what few nodes there are: each is read once and tested by all, which
/// is cheaper than gathering every lane's own.
inline constexpr int kSharedLevels = kLanes > 1 ? 3 : 0;

/// Both halves of the lanes' inner nodes, which are `level` below the root.
struct Halves {
  Real first, second;
};
inline Halves halves_of(const SceneView<T>& scene, Int children, const Chooser& at, int level,
                        Mask active) {
  if (level >= kSharedLevels) {
    const auto of = [&](Int node) {
      const Int base = node * Int(kLightNodeStride);
      return cluster_contribution([&](unsigned k) { return gather(scene.light_nodes + k, base); },
                                  at);
    };
    return {of(children), of(children + Int(1U))};
  }
  Halves halves{Real(0), Real(0)};
  for_each_distinct(children, active, [&](std::uint32_t i, Mask m) {
    const auto of = [&](std::uint32_t node) {
      const T* row = scene.light_nodes + std::size_t{node} * kLightNodeStride;
      return cluster_contribution([&](unsigned k) { return Real(row[k]); }, at);
    };
    halves.first = select(m, of(i), halves.first);
    halves.second = select(m, of(i + 1), halves.second);
  });
  return halves;
}

/// By 32 random bits; pmf 0 where the way ended between two halves that bring nothing.
inline LightChoice choose_by_tree(const SceneView<T>& scene, const Chooser& at, Int random,
                                  Mask active) {
  // Each turn takes random bits off the top; a hash refills those below.
  Real u = unit_from_bits(random);
  Int refill = random;
  Int node(0U);
  Real pmf(1);
  Int child = gather(scene.light_children, node);
  Mask inner = active && (child & Int(kLightLeaf)) == Int(0U);
  for (int level = 0; any(inner); ++level) {
    const Int children = select(inner, child, Int(0U));
    const Halves h = halves_of(scene, children, at, level, inner);
    const Real total = h.first + h.second;
    const Mask some = inner && total > Real(0);
    const Real p = select(some, h.first / select(some, total, Real(1)), Real(0));
    refill = hash(refill);
    u = u + unit_from_bits(refill) * T(0x1p-24);
    const Mask left = u < p;
    const Real share = select(left, p, Real(1) - p);
    pmf = select(inner, select(some, pmf * share, Real(0)), pmf);
    u = select(left, u, u - p) / select(share > Real(0), share, Real(1));
    u = min(u, Real(T(1) - kEpsilon));
    node = select(left, children, children + Int(1U));
    child = select(some, gather(scene.light_children, node), child);
    inner = some && (child & Int(kLightLeaf)) == Int(0U);
  }
  const Mask leaf = active && (child & Int(kLightLeaf)) != Int(0U);
  return {select(leaf, child & Int(~kLightLeaf), Int(0U)), Int(kStraight),
          select(leaf, pmf, Real(0))};
}

/// Probability with which the point chooses the light.
inline Real pmf_by_tree(const SceneView<T>& scene, const Chooser& at, Int light, Mask active) {
  Int trail = gather(scene.light_trail, select(active, light, Int(0U)));
  const Mask known = active && trail != Int(kNoTrail);
  Real pmf = select(known, Real(1), Real(0));
  Int child = gather(scene.light_children, Int(0U));
  Mask inner = known && (child & Int(kLightLeaf)) == Int(0U);
  for (int level = 0; any(inner); ++level) {
    const Int children = select(inner, child, Int(0U));
    const Halves h = halves_of(scene, children, at, level, inner);
    const Mask second = (trail & Int(1U)) == Int(1U);
    const Real total = h.first + h.second;
    const Real p = h.first / select(total > Real(0), total, Real(1));
    const Real share = select(total > Real(0), select(second, Real(1) - p, p), Real(0));
    pmf = select(inner, pmf * share, pmf);
    child = select(
        inner, gather(scene.light_children, select(second, children + Int(1U), children)), child);
    trail = trail >> 1;
    inner = inner && (child & Int(kLightLeaf)) == Int(0U);
  }
  return pmf;
}

LIGHTBENCH_KERNEL_END
