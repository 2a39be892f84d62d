#pragma once
// Next-event estimation: one sample of one light from each vertex, straight, by way of a mirror or
// through glass.

#include "core/accel/closest_hit.h"
#include "core/film/counters.h"
#include "core/kernel/emission.h"
#include "core/kernel/uses.h"
#include "core/lights/detour.h"
#include "core/materials/scatter.h"
#include "core/media/medium.h"
#include "core/sampling/dimensions.h"

LIGHTBENCH_KERNEL_BEGIN

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
                                               const Frame& frame, Mask active, Paths& paths,
                                               Counters& counters, Watch& watch) {
  const Bits2 random = light_numbers(scene, paths.sampler, vertex_number(paths));
  const Chooser at{v.reflect_from, select(v.in_medium, Vec(Real(0)), v.n), paths.ray.time};
  Real scale;
  const LightChoice chosen = choose_light(scene, at, random.x, active, scale);
  if (point_chooses(scene)) {
    paths.choice_scale = select(active, scale, paths.choice_scale);
    paths.chosen_from = select(active, at.p, paths.chosen_from);
    paths.chosen_n = select(active, at.n, paths.chosen_n);
    active = active && chosen.pmf > Real(0);
    if (none(active)) return;
  }
  const LightPlace place = place_of(scene, chosen.light);
  const Vec2 u{chosen.rest, unit_from_bits(random.y)};
  const bool detours = has_detours(scene);
  const Mask detour = active && chosen.via != Int(kStraight);
  const bool some_detour = detours && any(detour);
  Mask by_lens(false), by_pane(false), mirrored_lanes(false);
  Vec seen_from = v.reflect_from;
  if (some_detour) {
    by_lens = detour && is_lens(scene, chosen.via);
    if (uses(scene, Feature::ImagesInPanes)) by_pane = detour && is_pane(scene, chosen.via);
    // One segment more than the straight way, or two.
    const Int more = select(by_lens || by_pane, Int(2U), Int(1U));
    active = active &&
             (!detour || paths.segments + more < Int(static_cast<std::uint32_t>(scene.max_depth)));
    if (none(active)) return;
    by_lens = by_lens && active;
    by_pane = by_pane && active;
    mirrored_lanes = detour && active && !by_lens && !by_pane;
    if (any(mirrored_lanes)) {
      const Face mirror = faces_of(scene, chosen.via, mirrored_lanes);
      seen_from = select(mirrored_lanes, mirrored(mirror, seen_from), seen_from);
    }
    if (uses(scene, Feature::ImagesInPanes) && any(by_pane))
      seen_from =
          select(by_pane, seen_by_pane(scene, at, chosen.light, chosen.via, by_pane), seen_from);
  }
  LightSample s = sample_light(scene, place, seen_from, paths.ray.time, u, active && !by_lens);
  const Mask straight = active && !by_lens && !by_pane && !mirrored_lanes;
  const Mask own = straight && place.primitive == paths.ray.from;
  if (any(own)) sample_own_lights(scene, place, paths.ray, v.reflect_from, u, !v.front, own, s);
  Vec wi = s.d;
  Detour way;
  if (some_detour) {
    way = straight_on();
    if (any(mirrored_lanes)) take_mirror(scene, chosen.via, mirrored_lanes, v.reflect_from, s, way);
    if (uses(scene, Feature::ImagesInGlass) && any(by_lens))
      take_lens(scene, at, chosen, place, u, by_lens, s, way);
    if (uses(scene, Feature::ImagesInPanes) && any(by_pane))
      take_pane(scene, at, chosen.via, place, by_pane, s, way);
    seen_from = select(by_lens || by_pane, way.origin, seen_from);
    wi = select(way.taken, way.d, s.d);
  }

  BsdfValue value{Vec(Real(T(0.25) * kInvPi)), Real(kPdfSphere)};
  value.f = value.f * v.material.base_color;  // isotropic phase function times albedo
  if (any(v.on_surface && s.valid)) {
    BsdfValue f = eval_bsdf(scene, v.material, frame, v.wo, wi);
    const Mask above = dot(v.ng, wi) > Real(0);
    value.f = select(v.in_medium, value.f, select(above, f.f, Vec(Real(0))));
    value.pdf = select(v.in_medium, value.pdf, f.pdf);
  }

  Ray shadow;
  shadow.o = seen_from;
  shadow.d = s.d;
  shadow.time = paths.ray.time;
  const Vec emission = light_radiance(scene, place, s, shadow);

  const Real pdf = s.pdf * chosen.pmf;
  const Real other = some_detour ? value.pdf * way.passing : value.pdf;
  const Real share = scene.counts_hits_of_lights ? power_heuristic(pdf, other) : Real(1);
  const Real weight = share / pdf;
  Vec light = paths.throughput * value.f * emission * weight;
  if (some_detour) light = light * way.color;
  if constexpr (Watch::kOn) {
    watch.light_sampled(chosen, s, wi, value, emission, weight * pdf,
                        some_detour ? way.by : Int(kNoHit));
  }
  Mask wanted = s.valid && max_component(light) > Real(0);
  if (none(wanted)) return;
  shadow.from = select(v.in_medium, Int(kNoHit), paths.ray.from);
  shadow.from_slot = paths.ray.from_slot;
  // Within a room its own walls are in the way of what is outside.
  shadow.inside = v.on_surface && !v.front;
  shadow.o = v.reflect_from;
  Real length = s.distance;
  Int blocker(kNoHit);
  if (some_detour) {
    shadow.d = wi;
    shadow.skip = way.by;
    shadow.skip_slot = Int(kNoHit);
    shadow.skip_back = false;
    blocker = trace_leg(scene, shadow, way.t, wanted && way.taken, light, wanted, counters);
    // What follows leaves the mirror or the lens, to the outside: only outer faces of solids
    // mirror.
    shadow.from = select(way.taken, way.by, shadow.from);
    shadow.inside = shadow.inside && !way.taken;
    shadow.from_slot = select(way.taken, Int(kNoHit), shadow.from_slot);
    if (any(wanted && way.crowded)) {
      shadow.o = way.inner;
      shadow.d = way.within;
      const Int inside =
          trace_leg(scene, shadow, way.chord, wanted && way.crowded, light, wanted, counters);
      blocker = select(inside != Int(kNoHit), inside, blocker);
    }
    shadow.o = select(way.taken, way.origin, v.reflect_from);
    shadow.d = s.d;
    length = select(way.taken, way.rest, length);
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
