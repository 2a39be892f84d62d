#pragma once
// Unidirectional path tracing with next-event estimation and multiple importance sampling (power
// heuristic). One path per lane, advanced one vertex at a time; a lane whose path has ended takes
// the next (pixel, sample) before the lanes are shaded, so that none idles there while work is
// left.

#include "core/kernel/direct_light.h"
#include "core/kernel/path_end.h"
#include "core/kernel/path_queue.h"

LIGHTBENCH_KERNEL_BEGIN

/// Survival of roulette over the path's throughput. 1 keeps all paths alike; twice that traces 5 %
/// more rays for 14 % less squared error in the headline scene (docs/performance.md).
inline constexpr T kRouletteSurvival = 2;

/// Takes every live path from what its ray met to its next ray: emission, direct light, scattering.
template <class Watch>
inline void shade(const SceneView<T>& scene, Paths& paths, const Interaction& met,
                  Counters& counters, Watch& watch) {
  const NearestHit& hit = met.hit;
  const MediumHit& medium = met.medium;
  const Int vertex = vertex_number(paths);
  Vertex v;
  v.in_medium = uses(scene, Feature::Media) ? paths.alive && medium.scattered : Mask(false);
  v.on_surface = paths.alive && !v.in_medium;
  Mask going = paths.alive;

  v.wo = -paths.ray.d;
  find_surface(scene, paths.ray, hit, v.on_surface, v);
  v.front = dot(v.wo, v.surface.ng) > Real(0);
  v.ng = select(v.front, v.surface.ng, -v.surface.ng);
  v.n = select(v.front, v.surface.ns, -v.surface.ns);
  // An interpolated normal that looks away from the viewer cannot shade; the geometric one can.
  v.n = select(dot(v.n, v.wo) > Real(0), v.n, v.ng);
  if (uses(scene, Feature::Emission) && any(v.on_surface))
    add_emission(scene, v, hit, paths, watch);

  v.reflect_from = leave_surface(v.surface.p, v.ng, v.offset);
  if (uses(scene, Feature::Media)) {
    const Vec p = madd(paths.ray.d, medium.t, paths.ray.o);
    v.reflect_from = select(v.in_medium, p, v.reflect_from);
    v.material.base_color = select(v.in_medium, medium.albedo, v.material.base_color);
    v.n = select(v.in_medium, v.wo, v.n);
  }
  if constexpr (Watch::kOn) watch.vertex(v, hit, medium);
  going = going && paths.segments < Int(static_cast<std::uint32_t>(scene.max_depth));
  if constexpr (Watch::kOn) watch.going(going, PathEnd::Depth);
  going = going && (v.in_medium || !is_kind(v.material, BsdfKind::Black));
  if constexpr (Watch::kOn) watch.going(going, PathEnd::Black);
  const Frame frame(v.n);
  // From here on the ray remembers the surface it leaves.
  paths.ray.from = select(v.in_medium, Int(kNoHit), hit.primitive);
  paths.ray.from_slot = hit.slot;
  const Mask lit = going && (v.in_medium || !is_delta_or_black(v.material));
  if (uses(scene, Feature::Lights) && any(lit))
    add_direct_light(scene, v, frame, lit, paths, counters, watch);

  const Vec2 u = direction_numbers(scene, paths.sampler, vertex);
  Real u_fuzz(0);
  if (uses(scene, Feature::Fuzz) && any(is_kind(v.material, BsdfKind::Fuzz)))
    u_fuzz = fuzz_number(paths.sampler, vertex);
  BsdfSample next = sample_bsdf(scene, v.material, frame, v.wo, v.front, u, u_fuzz);
  const Mask same_side = dot(next.wi, v.ng) > Real(0);
  // Shading normals can send a reflection below the real surface, or a refraction above it.
  next.valid = next.valid && same_side == (dot(next.wi, v.n) > Real(0));
  if (uses(scene, Feature::Media)) {
    const Mask m = v.in_medium;
    next.wi = select(m, square_to_sphere(u), next.wi);
    next.weight = select(m, medium.albedo, next.weight);
    next.pdf = select(m, Real(kPdfSphere), next.pdf);
    next.valid = next.valid || m;
    next.delta = next.delta && !m;
  }
  going = going && next.valid;
  if constexpr (Watch::kOn) {
    watch.scattered(next);
    watch.going(going, PathEnd::Absorbed);
  }
  paths.throughput = paths.throughput * next.weight;
  Mask unknown = next.delta;
  if (has_detours(scene)) {
    // A first mirror keeps the density that the ray had, and refraction into and out of glass that
    // and its own probability: light sampling knows those ways too.
    const Mask followed = next.delta && paths.pdf > Real(0);
    const Mask first = followed && paths.via == Int(kStraight);
    const Int before = paths.via;
    paths.via = Int(kStraight);
    if (any(followed)) {
      paths.via =
          face_of(scene, hit.primitive, v.ng, first && is_kind(v.material, BsdfKind::Mirror));
      if (uses(scene, Feature::ImagesInGlass) || uses(scene, Feature::ImagesInPanes)) {
        const Mask through = followed && is_kind(v.material, BsdfKind::Dielectric) && !same_side;
        Int glass(kStraight);
        if (uses(scene, Feature::ImagesInGlass)) glass = lens_of(scene, hit.primitive, through);
        // The normal into the box by which a ray leaves is that of the face by which it came.
        if (uses(scene, Feature::ImagesInPanes))
          glass = min(glass, face_of(scene, hit.primitive, v.ng, through));
        const Mask enters = through && first && v.front && glass != Int(kStraight);
        const Mask leaves = through && !v.front && glass != Int(kStraight) && before == glass;
        paths.left = select(enters, paths.ray.d, paths.left);
        paths.via = select(enters || leaves, glass, paths.via);
      }
      const Mask known = paths.via != Int(kStraight);
      next.pdf = select(
          known, select(is_kind(v.material, BsdfKind::Mirror), paths.pdf, paths.pdf * next.pdf),
          next.pdf);
      unknown = unknown && !known;
    }
  }
  paths.pdf = select(unknown, Real(0), next.pdf);
  if (uses(scene, Feature::Dielectric)) {
    const Mask refracted = v.on_surface && next.delta && !same_side;
    const Real ior2 = v.material.ior * v.material.ior;
    paths.roulette_scale =
        select(refracted, paths.roulette_scale * select(v.front, ior2, Real(1) / ior2),
               paths.roulette_scale);
  }
  const Mask roulette =
      going && paths.segments >= Int(static_cast<std::uint32_t>(scene.roulette_depth));
  if (any(roulette)) {
    // Not below 1 for a path that has lost nothing: divided by less at every bounce, the throughput
    // of a long one without losses (total reflection) would grow without limit.
    const Real survival =
        min(max_component(paths.throughput) * paths.roulette_scale * kRouletteSurvival, Real(1));
    const Real dice = roulette_number(paths.sampler, vertex);
    going = going && (!roulette || dice < survival);
    if constexpr (Watch::kOn) {
      watch.roulette(roulette, survival);
      watch.going(going, PathEnd::Roulette);
    }
    paths.throughput =
        select(roulette && going, paths.throughput * (Real(1) / survival), paths.throughput);
  }
  going = going && max_component(paths.throughput) > Real(0);
  if constexpr (Watch::kOn) watch.going(going, PathEnd::NoThroughput);
  const Vec through = leave_surface(v.surface.p, v.ng, -v.offset);
  paths.ray.o = select(same_side || v.in_medium, v.reflect_from, through);
  paths.ray.d = next.wi;
  paths.ray.inside = !v.in_medium && dot(next.wi, v.surface.ng) < Real(0);
  paths.alive = going;
}

inline void render_work(const SceneView<T>& scene, const Work& work, FilmView film,
                        Counters& counters) {
  PathQueue queue(scene, work, film, counters);
  Paths paths{};
  paths.ray.skip = paths.ray.skip_slot = Int(kNoHit);
  paths.ray.skip_back = paths.alive = Mask(false);
  Unwatched unwatched;
  for (Mask used(false);;) {
    Interaction met = intersect(scene, paths, counters);
    escape(scene, paths, met, unwatched);
    const Mask done = used && !paths.alive;
    if (any(done)) splat(scene, paths, done, work, film, counters);
    used = paths.alive || queue.fill(!paths.alive, paths, met);
    if (none(used)) return;
    shade(scene, paths, met, counters, unwatched);
  }
}

LIGHTBENCH_KERNEL_END
