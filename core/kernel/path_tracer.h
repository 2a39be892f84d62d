#pragma once
// Unidirectional path tracing with next-event estimation and multiple importance sampling (power
// heuristic). One path per lane, advanced one vertex at a time; a lane whose path ends takes the
// next (pixel, sample) at once, so lanes never idle while work is left.

#include "core/accel/closest_hit.h"
#include "core/accel/hit_surface.h"
#include "core/kernel/path_end.h"
#include "core/kernel/path_starts.h"
#include "core/kernel/paths.h"
#include "core/kernel/splat.h"
#include "core/lights/environment.h"
#include "core/lights/light.h"
#include "core/lights/light_choice.h"
#include "core/materials/scatter.h"
#include "core/media/medium.h"

LIGHTBENCH_KERNEL_BEGIN

/// What step() reports to is a template parameter; this one takes no reports and costs nothing.
/// core/query/path_watch.h has the one that writes a path down.
struct Unwatched {
  static constexpr bool kOn = false;
};

/// Where the paths scatter next: a surface point or a point in a medium.
struct Vertex {
  Surface surface;
  Material material;  ///< textures applied
  Vec object_point;   ///< the surface point in object space; only where solid textures are used
  Vec wo;
  Vec ng, n;   ///< geometric and shading normal on the side of wo
  Mask front;  ///< wo is outside
  Mask on_surface, in_medium;
  Vec reflect_from;  ///< origin of rays that leave on the side of wo
  Real offset;
};

/// Surface and material of the hits, with textures.
inline void find_surface(const SceneView<T>& scene, const Ray& ray, const NearestHit& hit,
                         Mask active, Vertex& v) {
  const Int primitive = select(active, hit.primitive, Int(0U));
  v.material = materials_of(scene, gather(scene.material, primitive), active);
  v.offset = select(active, gather(scene.offset, primitive), Real(0));
  v.surface = surface_of(scene, ray, hit, active, Mask(scene.needs_uv) && is_textured(v.material));
  v.object_point = Vec(Real(0));
  if (scene.to_object != nullptr) {
    for_each_distinct(primitive, active, [&](std::uint32_t i, Mask m) {
      const Affine to_object = affine_at(Row{scene.to_object + std::size_t{12} * i}, 0);
      v.object_point = select(m, to_object.point(v.surface.p), v.object_point);
    });
  }
  const auto apply = [&](Int texture, Vec& color) {
    const Mask textured = active && texture != Int(kNoTexture);
    if (none(textured)) return;
    const Vec value =
        eval_texture(scene, texture, v.surface.u, v.surface.v, v.object_point, textured);
    color = select(textured, color * value, color);
  };
  if (scene.has_textures) apply(v.material.base_color_texture, v.material.base_color);
  if (scene.has_emission_textures) apply(v.material.emission_texture, v.material.emission);
}

/// Where a ray starts that leaves surface point p on the side that the geometric normal n points
/// to (with -offset: on the other side); `offset` bounds the error of p.
inline Vec leave_surface(Vec p, Vec n, Real offset) { return madd(n, offset, p); }

/// Power heuristic for a strategy of density a against one of density b.
inline Real power_heuristic(Real a, Real b) {
  // In ratio form, which cannot overflow.
  const Real r = b / a;
  return Real(1) / fma(r, r, Real(1));
}

/// Radiance that the sampled lights send back along -s.d.
inline Vec light_radiance(const SceneView<T>& scene, LightPlace place, const LightSample& s,
                          const Ray& shadow) {
  const Mask front = dot(s.n, s.d) < Real(0);
  if (scene.has_emission_textures) {
    NearestHit hit{s.distance, place.primitive, place.slot, Real(0), Real(0)};
    // Triangles take their uv from barycentrics, which the test itself gives.
    for_each_kind(scene, place.primitive, s.valid, [&]<PrimitiveKind kKind>(Mask m) {
      if constexpr (kKind == PrimitiveKind::Triangle || kKind == PrimitiveKind::Mesh) {
        Triangle t;
        if constexpr (kKind == PrimitiveKind::Mesh) {
          t = mesh_light(scene, place, m).triangle;
        } else {
          t = triangle_at(rows_of<kKind>(scene, place.primitive, m));
        }
        const TriangleHit h = hit_triangle(t, shadow);
        hit.b1 = select(m, h.b1, hit.b1);
        hit.b2 = select(m, h.b2, hit.b2);
      }
    });
    Vertex v;
    find_surface(scene, shadow, hit, s.valid, v);
    return select(s.valid && (front || v.material.two_sided), v.material.emission, Vec(Real(0)));
  }
  Vec emission(Real(0));
  for_each_distinct(place.primitive, s.valid, [&](std::uint32_t i, Mask m) {
    const Row row{scene.materials + std::size_t{scene.material[i]} * kMaterialStride};
    const Mask facing = m && (front || Mask(row.base[12] > T(0)));
    emission = select(facing, row.vec(8), emission);
  });
  return emission;
}

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
  const bool some_mirrored = scene.mirror_count > 0 && any(way.mirrored);
  Vec seen_from = v.reflect_from;
  if (some_mirrored) {
    // One segment more than the straight way.
    way.mirrored =
        way.mirrored && paths.segments + Int(1U) < Int(static_cast<std::uint32_t>(scene.max_depth));
    active = active && (way.mirrored || chosen.mirror == Int(kNoMirror));
    if (none(active)) return;
    way.mirror =
        mirror_at(merged_rows<kMirrorStride>(chosen.mirror, way.mirrored, [&](std::uint32_t i) {
          return scene.mirrors + i * kMirrorStride;
        }));
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
  // Both ends are kept apart from their surfaces by identity and by the offset; the margin only
  // covers the rounding of the distance itself, for surfaces that touch the light.
  constexpr T kShort = T(1) - 16 * kEpsilon;
  Real distance = s.distance;
  Int blocker(kNoHit);
  if (some_mirrored) {
    const Mask to_mirror = wanted && way.mirrored;
    if (any(to_mirror)) {
      shadow.o = v.reflect_from;
      shadow.d = way.d;
      shadow.skip = to_int(way.mirror.primitive);
      shadow.skip_slot = Int(kNoHit);
      shadow.skip_back = false;
      NearestHit hit = no_hit(way.t * kShort);
      find_hits<true>(scene, shadow, to_mirror, hit);
      counters.shadow_rays += static_cast<std::uint64_t>(__builtin_popcount(bits(to_mirror)));
      const Mask visible = to_mirror && hit.primitive == Int(kNoHit);
      if (scene.medium_count > 0 && any(visible))
        light = select(visible, light * transmittance(scene, shadow, way.t, visible), light);
      blocker = select(to_mirror, hit.primitive, blocker);
      wanted = wanted && (visible || !way.mirrored);
      shadow.d = s.d;
      // The second part leaves the mirror.
      shadow.o = select(way.mirrored, leave_surface(way.through, way.mirror.n, way.mirror.offset),
                        v.reflect_from);
      shadow.from = select(way.mirrored, to_int(way.mirror.primitive), shadow.from);
      shadow.from_slot = select(way.mirrored, Int(kNoHit), shadow.from_slot);
      distance = select(way.mirrored, distance - way.t, distance);
    } else {
      shadow.o = v.reflect_from;
    }
  }
  shadow.skip = place.primitive;
  shadow.skip_slot = place.slot;
  shadow.skip_back = dot(s.n, s.d) >= Real(0);
  NearestHit hit = no_hit(distance * kShort);
  if (any(wanted)) find_hits<true>(scene, shadow, wanted, hit);
  counters.shadow_rays += static_cast<std::uint64_t>(__builtin_popcount(bits(wanted)));
  const Mask visible = wanted && hit.primitive == Int(kNoHit);
  if (scene.medium_count > 0 && any(visible))
    light = light * transmittance(scene, shadow, distance, visible);
  if constexpr (Watch::kOn)
    watch.light_arrived(select(wanted, hit.primitive, blocker), visible, light);
  paths.radiance = select(visible, paths.radiance + light, paths.radiance);
}

/// The light that was hit, in the lanes where it is one that the sampler can choose; 0 elsewhere.
struct KnownLight {
  Int light;
  Mask known, mesh;
};
inline KnownLight light_of(const SceneView<T>& scene, const NearestHit& hit, Mask active) {
  const Int primitive = select(active, hit.primitive, Int(0U));
  const Int first_light = gather(scene.first_light, primitive);
  const Mask known = active && first_light != Int(kNoLight);
  const Mask mesh =
      gather(scene.kind, primitive) == Int(static_cast<std::uint32_t>(PrimitiveKind::Mesh));
  return {select(known, first_light + select(mesh, hit.slot, Int(0U)), Int(0U)), known, mesh};
}

/// Emission met by the paths' own rays, weighted against light sampling.
template <class Watch>
inline void add_emission(const SceneView<T>& scene, const Vertex& v, const NearestHit& hit,
                         Paths& paths, Watch& watch) {
  const Mask bright = v.on_surface && (v.front || v.material.two_sided) &&
                      max_component(v.material.emission) > Real(0);
  if (none(bright)) return;
  Real weight(1);
  const Mask sampled = bright && paths.pdf > Real(0);
  if (scene.samples_lights && any(sampled)) {
    const auto [light, known, mesh] = light_of(scene, hit, sampled);
    // By a mirror the light was sampled from the mirrored point, which lies behind the ray's
    // origin.
    Vec from = paths.ray.o;
    Real distance = hit.t;
    const Mask mirrored_lanes = known && paths.mirror != Int(kNoMirror);
    if (scene.mirror_count > 0 && any(mirrored_lanes)) {
      const Mirror mirror =
          mirror_at(merged_rows<kMirrorStride>(paths.mirror, mirrored_lanes, [&](std::uint32_t i) {
            return scene.mirrors + i * kMirrorStride;
          }));
      from = select(mirrored_lanes, mirrored(mirror, paths.chosen_from), from);
      distance = select(mirrored_lanes, distance + length(paths.ray.o - from), distance);
    }
    Real of_shape = pdf_light(scene, {hit.primitive, hit.slot}, from, paths.ray.time, paths.ray.d,
                              distance, v.surface.ng, known);
    // As sample_own_lights() has it.
    const Mask own =
        known && !mirrored_lanes && hit.primitive == paths.ray.from && paths.ray.inside;
    of_shape = select(own && !mesh, Real(kPdfSphere), of_shape);
    const Real pmf = pmf_of_light(scene, {paths.chosen_from, paths.chosen_n}, light, paths.mirror,
                                  paths.choice_scale, known);
    const Real pdf = pmf * of_shape;
    // Light sampling alone leaves only what it cannot choose to the paths' own rays.
    const Real share = scene.counts_hits_of_lights ? power_heuristic(paths.pdf, pdf)
                                                   : select(pdf > Real(0), Real(0), Real(1));
    weight = select(known, share, weight);
  }
  if constexpr (Watch::kOn) watch.emitted(bright, v.material.emission, weight);
  paths.radiance = select(
      bright, madd(paths.throughput * v.material.emission, weight, paths.radiance), paths.radiance);
}

/// Survival of roulette over the path's throughput. 1 keeps all paths alike; twice that traces 5 %
/// more rays for 14 % less squared error in the headline scene (docs/performance.md).
inline constexpr T kRouletteSurvival = 2;

/// Advances every live path by one vertex.
template <class Watch>
inline void step(const SceneView<T>& scene, Paths& paths, Counters& counters, Watch& watch) {
  const Mask alive = paths.alive;
  counters.rays += static_cast<std::uint64_t>(__builtin_popcount(bits(alive)));
  NearestHit hit = no_hit(Real(kInfinity));
  find_hits<false>(scene, paths.ray, alive, hit);
  if (scene.has_triangles) refine_hits(scene, paths.ray, hit);
  const Int dimension_base =
      paths.segments * Int(dimension::kPerVertex) + Int(dimension::kFirstVertex);
  paths.segments = select(alive, paths.segments + Int(1U), paths.segments);

  Vertex v;
  v.in_medium = false;
  MediumHit medium{hit.t, Vec(Real(1)), Mask(false)};
  if (scene.medium_count > 0) {
    medium = sample_media(scene, paths.ray, hit.t, paths.sampler, dimension_base, alive);
    v.in_medium = medium.scattered;
  }
  const Mask hit_something = hit.primitive != Int(kNoHit);
  v.on_surface = alive && hit_something && !v.in_medium;
  const Mask escaped = alive && !hit_something && !v.in_medium;
  if (scene.has_environment && any(escaped)) {
    const Vec sky = environment_radiance(scene, paths.ray.d, escaped);
    if constexpr (Watch::kOn) watch.emitted(escaped, sky, Real(1));
    paths.radiance = select(escaped, paths.radiance + paths.throughput * sky, paths.radiance);
  }
  Mask going = v.on_surface || v.in_medium;
  if constexpr (Watch::kOn) watch.going(going, PathEnd::Escaped);
  if (none(going)) {
    paths.alive = false;
    return;
  }

  v.wo = -paths.ray.d;
  find_surface(scene, paths.ray, hit, v.on_surface, v);
  v.front = dot(v.wo, v.surface.ng) > Real(0);
  v.ng = select(v.front, v.surface.ng, -v.surface.ng);
  v.n = select(v.front, v.surface.ns, -v.surface.ns);
  // An interpolated normal that looks away from the viewer cannot shade; the geometric one can.
  v.n = select(dot(v.n, v.wo) > Real(0), v.n, v.ng);
  if (scene.has_emission && any(v.on_surface)) add_emission(scene, v, hit, paths, watch);

  v.reflect_from = leave_surface(v.surface.p, v.ng, v.offset);
  if (scene.medium_count > 0) {
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
  if (scene.samples_lights && any(lit))
    add_direct_light(scene, v, frame, dimension_base, lit, paths, counters, watch);

  const Vec2 u = paths.sampler.pair(dimension_base + Int(dimension::kBsdf));
  const Mask wants_lobe =
      is_kind(v.material, BsdfKind::Dielectric) || is_kind(v.material, BsdfKind::Fuzz);
  const Real u_lobe =
      any(wants_lobe) ? paths.sampler.pair(dimension_base + Int(dimension::kDistance)).x : Real(0);
  BsdfSample next = sample_bsdf(scene, v.material, frame, v.wo, v.front, u, u_lobe);
  const Mask same_side = dot(next.wi, v.ng) > Real(0);
  // Shading normals can send a reflection below the real surface, or a refraction above it.
  next.valid = next.valid && same_side == (dot(next.wi, v.n) > Real(0));
  if (scene.medium_count > 0) {
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
  if (scene.mirror_count > 0) {
    // A first mirror keeps the density that the ray had: light sampling knows that way too.
    const Mask first = next.delta && paths.pdf > Real(0) && paths.mirror == Int(kNoMirror);
    paths.mirror = Int(kNoMirror);
    if (any(first)) {
      paths.mirror =
          mirror_of(scene, hit.primitive, v.ng, first && is_kind(v.material, BsdfKind::Mirror));
      const Mask mirrored_lanes = paths.mirror != Int(kNoMirror);
      next.pdf = select(mirrored_lanes, paths.pdf, next.pdf);
      unknown = unknown && !mirrored_lanes;
    }
  }
  paths.pdf = select(unknown, Real(0), next.pdf);
  if (scene.has_dielectric) {
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
    const Real dice = paths.sampler.pair(dimension_base + Int(dimension::kChoice)).y;
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
  PathStarts starts(scene, work, film);
  Paths paths{};
  paths.ray.skip = paths.ray.skip_slot = Int(kNoHit);
  paths.ray.skip_back = paths.alive = Mask(false);
  Unwatched unwatched;
  Mask used = starts.fill(Mask(true), paths);
  while (any(used)) {
    step(scene, paths, counters, unwatched);
    const Mask done = used && !paths.alive;
    if (none(done)) continue;
    splat(scene, paths, done, work, film, counters);
    used = paths.alive || starts.fill(done, paths);
  }
}

LIGHTBENCH_KERNEL_END
