#pragma once
// Choice among many lights by what each would bring to the point: one of the clusters of a coarse
// level of a binary tree, which all lanes estimate together, and from there down, at each node in
// proportion to an estimate of the two halves (Conty Estevez & Kulla, "Importance Sampling of Many
// Lights with Adaptive Tree Splitting", 2018; pbrt-v4 12.6.3).

#include "core/lights/chooser.h"
#include "core/sampling/hash.h"

LIGHTBENCH_KERNEL_BEGIN

/// Estimate of the irradiance that a node sheds on the point. Its row is
///   0..2 centre and 3 radius of a ball around the lights, 4 their weight, 5..7 axis, 8 cosine and
///   9 sine of a cone around their normals, which is of a half turn at most or (cosine -1) all
///   directions, 10 a quarter of the inverse of the radius.
/// As for single lights, but that the cosine at the lights is the best that cone and ball allow.
inline Real cluster_contribution(const auto& c, const Chooser& at) {
  const Vec d = c.vec(0) - at.p;
  const Real r = c[3], rr = r * r;
  const Real d2 = max(length_squared(d), rr * T(1e-4)), sum = d2 + rr;
  const Real distance = sqrt(d2);
  const Real receiver =
      select(looks_all_around(at), distance, clipped_height(dot(at.n, d), r, c[10]));
  const Real flow = c[4] * receiver / (distance * sum);
  if (none(!c.below(8, T(0)))) return flow;
  const Real inverse = Real(1) / sqrt(sum);
  const Real cos_ball = distance * inverse, sin_ball = r * inverse;
  const Real cos_cone = c[8], sin_cone = c[9];
  const Real cos_both = cos_cone * cos_ball - sin_cone * sin_ball;
  const Real sin_both = sin_cone * cos_ball + cos_cone * sin_ball;
  const Real cosine = -dot(c.vec(5), d) / distance;
  const Real sine = safe_sqrt(Real(1) - cosine * cosine);
  // The angle to the axis less those of the cone and the ball; all of a half turn or more is 1.
  const Mask inside = cosine >= cos_both || sin_both <= Real(0);
  return flow * select(inside, Real(1), max(cosine * cos_both + sine * sin_both, Real(0)));
}

inline Mask is_inner(Int child) { return (child & Int(kLightLeaf)) == Int(0U); }

/// A lane's own node.
inline Real node_contribution(const SceneView<T>& scene, Int node, const Chooser& at) {
  return cluster_contribution(GatheredRow{scene.light_nodes, node * Int(kLightNodeStride)}, at);
}

/// By 32 random bits; pmf 0 where the way ended between halves that bring nothing. `scale` = 1 /
/// the sum of the first clusters' contributions, or 0.
inline LightChoice choose_by_tree(const SceneView<T>& scene, const Chooser& at, Int random,
                                  Mask active, Real& scale) {
  const std::uint32_t clusters = scene.light_clusters;
  Contributions c;
  c.total = Real(0);
  for (std::uint32_t i = 0; i < clusters; ++i) {
    const T* row = scene.light_nodes + std::size_t{clusters - 1 + i} * kLightNodeStride;
    c.of[i] = cluster_contribution(Row{row}, at);
    c.total += c.of[i];
  }
  scale = select(c.total > Real(0), Real(1) / c.total, Real(0));
  Real u = unit_from_bits(random);
  Int node(0U);
  const Picked cluster = pick(c, u, clusters, [&](std::uint32_t i, Mask m) {
    node = select(m, Int(clusters - 1 + i), node);
  });
  // What is left of the number within the share that was chosen, stretched to [0,1): each choice
  // takes random bits off its top, and a hash makes new ones for its end before it is stretched.
  Int refill = random;
  const auto stretch = [&](Real rest, Real share) {
    refill = hash(refill);
    return stretched(rest, share, unit_from_bits(refill) * kUnitSpacing);
  };
  Real pmf = cluster.value * scale;
  u = stretch(u - cluster.before * scale, pmf);
  Int child = gather(scene.light_children, node);
  Mask inner = active && pmf > Real(0) && is_inner(child);
  while (any(inner)) {
    const Int children = select(inner, child, Int(0U));
    const Real first = node_contribution(scene, children, at);
    const Real total = first + node_contribution(scene, children + Int(1U), at);
    const Mask some = inner && total > Real(0);
    const Real p = select(some, first / select(some, total, Real(1)), Real(0));
    const Mask left = u < p;
    const Real share = select(left, p, Real(1) - p);
    pmf = select(inner, select(some, pmf * share, Real(0)), pmf);
    u = select(inner, stretch(select(left, u, u - p), share), u);
    node = select(left, children, children + Int(1U));
    child = select(some, gather(scene.light_children, node), child);
    inner = some && is_inner(child);
  }
  const Mask leaf = active && !is_inner(child);
  return {select(leaf, child & Int(~kLightLeaf), Int(0U)), Int(kStraight),
          select(leaf, pmf, Real(0)), u};
}

/// Probability with which the point chooses the light, by the `scale` that its choice gave.
inline Real pmf_by_tree(const SceneView<T>& scene, const Chooser& at, Int light, Real scale,
                        Mask active) {
  Int trail = gather(scene.light_trail, select(active, light, Int(0U)));
  const Mask known = active && trail != Int(kNoTrail);
  const Int first(scene.light_clusters - 1);
  const Int node = select(known, first + (trail & first), first);
  Real pmf = select(known, node_contribution(scene, node, at) * scale, Real(0));
  trail = trail >> scene.light_cluster_bits;
  Int child = gather(scene.light_children, node);
  Mask inner = known && is_inner(child);
  while (any(inner)) {
    const Int children = select(inner, child, Int(0U));
    const Real one = node_contribution(scene, children, at);
    const Real total = one + node_contribution(scene, children + Int(1U), at);
    const Mask second = (trail & Int(1U)) == Int(1U);
    const Real p = one / select(total > Real(0), total, Real(1));
    const Real share = select(total > Real(0), select(second, Real(1) - p, p), Real(0));
    pmf = select(inner, pmf * share, pmf);
    child = select(
        inner, gather(scene.light_children, select(second, children + Int(1U), children)), child);
    trail = trail >> 1;
    inner = inner && is_inner(child);
  }
  return pmf;
}

LIGHTBENCH_KERNEL_END
