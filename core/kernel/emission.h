#pragma once
// What lights send along a ray, and what it weighs against the other way of finding it.

#include "core/kernel/paths.h"
#include "core/kernel/uses.h"
#include "core/kernel/vertex.h"
#include "core/lights/light.h"
#include "core/lights/light_choice.h"
#include "core/lights/pane.h"

LIGHTBENCH_KERNEL_BEGIN

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
  if (uses(scene, Feature::EmissionTextures)) {
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
  const Int primitive = select(s.valid, place.primitive, Int(0U));
  const Material material = materials_of(scene, pick(scene.material, primitive), s.valid);
  return select(front || material.two_sided, material.emission, Vec(Real(0)));
}

/// The light that was hit, in the lanes where it is one that the sampler can choose; 0 elsewhere.
struct KnownLight {
  Int light;
  Mask known, mesh;
};
inline KnownLight light_of(const SceneView<T>& scene, const NearestHit& hit, Mask active) {
  const Int primitive = select(active, hit.primitive, Int(0U));
  const Int first_light = pick(scene.first_light, primitive);
  const Mask known = active && first_light != Int(kNoLight);
  constexpr auto kMesh = static_cast<unsigned>(PrimitiveKind::Mesh);
  const Mask mesh = active && hit.primitive >= Int(scene.kind_begin[kMesh]) &&
                    hit.primitive < Int(scene.kind_begin[kMesh + 1]);
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
  if (uses(scene, Feature::Lights) && any(sampled)) {
    const auto [light, known, mesh] = light_of(scene, hit, sampled);
    // By a mirror the light was sampled from the mirrored point, which lies behind the ray's
    // origin.
    Vec from = paths.ray.o;
    Real distance = hit.t;
    const Mask by_lens = known && is_lens(scene, paths.via);
    const Mask by_pane =
        Mask(uses(scene, Feature::ImagesInPanes)) && known && is_pane(scene, paths.via);
    const Mask straight = paths.via == Int(kStraight);
    const Mask mirrored_lanes = known && !straight && !by_lens && !by_pane;
    if (uses(scene, Feature::ImagesInMirrors) && any(mirrored_lanes)) {
      const Face mirror = faces_of(scene, paths.via, mirrored_lanes);
      from = select(mirrored_lanes, mirrored(mirror, paths.chosen_from), from);
      distance = select(mirrored_lanes, distance + length(paths.ray.o - from), distance);
    }
    Real of_shape = pdf_light(scene, {hit.primitive, hit.slot}, from, paths.ray.time, paths.ray.d,
                              distance, v.surface.ng, known);
    // As sample_own_lights() has it.
    const Mask own = known && straight && hit.primitive == paths.ray.from && paths.ray.inside;
    of_shape = select(own && !mesh, Real(kPdfSphere), of_shape);
    const Chooser at{paths.chosen_from, paths.chosen_n, paths.ray.time};
    if (uses(scene, Feature::ImagesInGlass) && any(by_lens))
      of_shape =
          select(by_lens, pdf_through(scene, at, light, paths.via, paths.left, by_lens), of_shape);
    if (uses(scene, Feature::ImagesInPanes) && any(by_pane)) {
      const LightPlace place{hit.primitive, hit.slot};
      const Real pdf = pdf_through_pane(scene, at, place, light, paths.via, paths.left, by_pane);
      of_shape = select(by_pane, pdf, of_shape);
    }
    const Real pmf = pmf_of_light(scene, at, light, paths.via, paths.choice_scale, known);
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

LIGHTBENCH_KERNEL_END
