#pragma once
// Next-event estimation: one sample of one light from each vertex, straight or by way of a mirror.

#include "core/accel/closest_hit.h"
#include "core/film/counters.h"
#include "core/kernel/emission.h"
#include "core/kernel/uses.h"
#include "core/materials/scatter.h"
#include "core/media/medium.h"

LIGHTBENCH_KERNEL_BEGIN

/// The way of a light sample by a mirror: to `t` along d, then on along the sample's own direction
/// from `through`. Where !mirrored the way is straight.
struct MirrorWay {
  Mask mirrored;
  Mirror mirror;
  Vec d, through;
  Real t;
};

/// Light sample in a mirror: from the mirrored point, where the way meets the mirror's face.
inline MirrorWay by_mirror(const Mirror& mirror, Mask mirrored_lanes, Vec from, LightSample& s) {
  MirrorWay way{mirrored_lanes, mirror, mirrored_direction(mirror, s.d), {}, {}};
  const Vec place = place_before(mirror, from);
  way.t = place.z / dot(mirror.n, s.d);
  way.through = madd(way.d, way.t, from);
  const Vec at = place_before(mirror, way.through);
  const Mask meets = way.t > Real(0) && way.t < s.distance && within_outline(mirror, at.x, at.y);
  s.valid = s.valid && (!mirrored_lanes || meets);
  return way;
}

/// Traces a part of the way to a light, as long as `length`: leaves in `light` what media let pass,
/// and takes the lanes of `leg` where something is in the way out of `wanted`; returns what.
inline Int trace_leg(const SceneView<T>& scene, const Ray& ray, Real length, Mask leg, Vec& light,
                     Mask& wanted, Counters& counters) {
  if (none(leg)) return Int(kNoHit);
  // Both ends are kept apart from their surfaces by identity and by the offset; the margin only
  // covers the rounding of the length itself, for surfaces that touch the light.
  NearestHit hit = no_hit(length * (T(1) - 16 * kEpsilon));
  find_hits<true>(scene, ray, leg, hit);
  counters.shadow_rays += static_cast<std::uint64_t>(__builtin_popcount(bits(leg)));
  const Mask visible = leg && hit.primitive == Int(kNoHit);
  if (uses(scene, Feature::Media) && any(visible))
    light = select(visible, light * transmittance(scene, ray, length, visible), light);
  wanted = wanted && (visible || !leg);
  return select(leg, hit.primitive, Int(kNoHit));
}

/// One light sample from each vertex of `active`, added to the paths' radiance. Never inlined, like
/// find_hits().
template <class Watch>
[[gnu::noinline]] inline void add_direct_light(const SceneView<T>& scene, const Vertex& v,
                                               const Frame& frame, Int dimension_base, Mask active,
                                               Paths& paths, Counters& counters, Watch& watch) {
  const Int random = paths.sampler.pair_bits(dimension_base + Int(dimension::kChoice)).x;
  const Chooser at{v.reflect_from, select(v.in_medium, Vec(Real(0)), v.n)};
  Real scale;
  const LightChoice chosen = choose_light(scene, at, random, active, scale);
  if (point_chooses(scene)) {
    paths.choice_scale = select(active, scale, paths.choice_scale);
    paths.chosen_from = select(active, at.p, paths.chosen_from);
    paths.chosen_n = select(active, at.n, paths.chosen_n);
    active = active && chosen.pmf > Real(0);
    if (none(active)) return;
  }
  const LightPlace place = place_of(scene, chosen.light);
  const Vec2 u = paths.sampler.pair(dimension_base + Int(dimension::kLight));
  MirrorWay way;
  way.mirrored = active && chosen.mirror != Int(kNoMirror);
  const bool some_mirrored = uses(scene, Feature::ImagesInMirrors) && any(way.mirrored);
  Vec seen_from = v.reflect_from;
  if (some_mirrored) {
    // One segment more than the straight way.
    way.mirrored =
        way.mirrored && paths.segments + Int(1U) < Int(static_cast<std::uint32_t>(scene.max_depth));
    active = active && (way.mirrored || chosen.mirror == Int(kNoMirror));
    if (none(active)) return;
    way.mirror = mirrors_of(scene, chosen.mirror, way.mirrored);
    seen_from = select(way.mirrored, mirrored(way.mirror, seen_from), seen_from);
  }
  LightSample s = sample_light(scene, place, seen_from, paths.ray.time, u, active);
  const Mask own = active && !way.mirrored && place.primitive == paths.ray.from;
  if (any(own)) sample_own_lights(scene, place, paths.ray, v.reflect_from, u, !v.front, own, s);
  Vec wi = s.d;
  if (some_mirrored) {
    way = by_mirror(way.mirror, way.mirrored, v.reflect_from, s);
    wi = select(way.mirrored, way.d, wi);
  }

  BsdfValue value{Vec(Real(T(0.25) * kInvPi)), Real(kPdfSphere)};
  value.f = value.f * v.material.base_color;  // isotropic phase function times albedo
  if (any(v.on_surface && s.valid)) {
    BsdfValue f = eval_bsdf(scene, v.material, frame, v.wo, wi);
    const Mask above = dot(v.ng, wi) > Real(0);
    value.f = select(v.in_medium, value.f, select(above, f.f, Vec(Real(0))));
    value.pdf = select(v.in_medium, value.pdf, f.pdf);
  }

  Ray shadow = paths.ray;
  shadow.o = seen_from;
  shadow.d = s.d;
  const Vec emission = light_radiance(scene, place, s, shadow);

  const Real pdf = s.pdf * chosen.pmf;
  const Real share = scene.counts_hits_of_lights ? power_heuristic(pdf, value.pdf) : Real(1);
  const Real weight = share / pdf;
  Vec light = paths.throughput * value.f * emission * weight;
  if (some_mirrored) light = select(way.mirrored, light * way.mirror.color, light);
  if constexpr (Watch::kOn) {
    const Int mirror = some_mirrored
                           ? select(way.mirrored, to_int(way.mirror.primitive), Int(kNoHit))
                           : Int(kNoHit);
    watch.light_sampled(chosen, s, wi, value, emission, weight * pdf, mirror);
  }
  Mask wanted = s.valid && max_component(light) > Real(0);
  if (none(wanted)) return;
  shadow.from = select(v.in_medium, Int(kNoHit), shadow.from);
  shadow.inside = false;
  shadow.o = v.reflect_from;
  Real length = s.distance;
  Int blocker(kNoHit);
  if (some_mirrored) {
    shadow.d = wi;
    shadow.skip = to_int(way.mirror.primitive);
    shadow.skip_slot = Int(kNoHit);
    shadow.skip_back = false;
    blocker = trace_leg(scene, shadow, way.t, wanted && way.mirrored, light, wanted, counters);
    // The second leg leaves the mirror.
    const Vec through = leave_surface(way.through, way.mirror.n, way.mirror.offset);
    shadow.o = select(way.mirrored, through, shadow.o);
    shadow.d = s.d;
    shadow.from = select(way.mirrored, shadow.skip, shadow.from);
    shadow.from_slot = select(way.mirrored, Int(kNoHit), shadow.from_slot);
    length = select(way.mirrored, length - way.t, length);
  }
  shadow.skip = place.primitive;
  shadow.skip_slot = place.slot;
  shadow.skip_back = dot(s.n, s.d) >= Real(0);
  const Int last = trace_leg(scene, shadow, length, wanted, light, wanted, counters);
  if constexpr (Watch::kOn)
    watch.light_arrived(select(blocker == Int(kNoHit), last, blocker), wanted, light);
  paths.radiance = select(wanted, paths.radiance + light, paths.radiance);
}

LIGHTBENCH_KERNEL_END
