#pragma once
// Boxes of clear glass, through whose opposite faces lights are sampled too. A ray that enters by
// one face and leaves by the other goes on in its old direction, moved sideways: so a light beyond
// is seen as if the point were nearer to it, by
//   thickness (1 - tan(theta') / tan(theta)),  sin(theta) = ior sin(theta'),
// which is the same for all of the light but for the change of theta over its extent. The light is
// sampled from the moved point, by its own sampler: the density of the directions is exact, and
// what they miss is left to the paths' own rays. In glass of an index above the root of two a ray
// that has come in by one face never leaves by one at right angles to it.

#include "core/lights/glass_way.h"
#include "core/lights/light.h"
#include "core/lights/light_choice.h"
#include "core/materials/dielectric.h"

LIGHTBENCH_KERNEL_BEGIN

/// Where p seems to be through the pane by a ray to the light whose image for upright rays is
/// around `image`.
inline Vec seen_through(const Face& pane, Vec image, Vec p) {
  const Real upright = pane.thickness * (Real(1) - Real(1) / pane.ior);
  const Vec to = image - p;
  const Real depth = upright - dot(pane.n, to);
  const Real aside = length(madd(pane.n, -dot(pane.n, to), to));
  const Real ior2 = pane.ior * pane.ior;
  Real shift = upright;
  // As many steps everywhere: any shift would do, a poor one only with more rays in vain.
  for (int i = 0; i < 3; ++i) {
    const Real tangent = aside / max(depth - shift, pane.thickness * T(1e-3));
    const Real within = Real(1) / sqrt(fma(tangent * tangent, ior2 - Real(1), ior2));
    shift = pane.thickness * (Real(1) - within);
  }
  return madd(pane.n, -shift, p);
}

/// The same for points that have chosen the light through the pane; the pairs have candidates.
[[gnu::noinline]] inline Vec seen_by_pane(const SceneView<T>& scene, const Chooser& at, Int light,
                                          Int via, Mask active) {
  const Int candidate = candidate_of(scene, light, via, active);
  return seen_through(faces_of(scene, via, active), candidates_of(scene, candidate, active).vec(0),
                      at.p);
}

inline GlassWay way_through(const Face& pane, Vec from, Vec d) {
  GlassWay w;
  const Vec place = place_before(pane, from);
  const Real cosine = min(-dot(d, pane.n), Real(1)), inverse = Real(1) / pane.ior;
  w.t = place.z / cosine;
  w.n_in = pane.n;
  w.n_out = -pane.n;
  w.p_in = madd(d, w.t, from);
  Real beyond;
  const Real passing = Real(1) - fresnel_dielectric(cosine, pane.ior, beyond);
  w.passing = passing * passing;
  w.d = normalize(madd(pane.n, fma(cosine, inverse, -beyond), d * inverse));
  w.chord = pane.thickness / beyond;
  w.p_out = madd(w.d, w.chord, w.p_in);
  w.d_out = d;
  const Vec in = place_before(pane, w.p_in), out = place_before(pane, w.p_out);
  w.valid = place.z > Real(0) && cosine > Real(0) && within_outline(pane, in.x, in.y) &&
            within_outline(pane, out.x, out.y);
  return w;
}

/// Density of direction d for a point that has chosen the light through the pane; 0 where that has
/// no candidate, or would not have been met.
[[gnu::noinline]] inline Real pdf_through_pane(const SceneView<T>& scene, const Chooser& at,
                                               LightPlace place, Int light, Int via, Vec d,
                                               Mask active) {
  const Int candidate = candidate_of(scene, light, via, active);
  const Mask known = active && candidate != Int(kNoLight);
  if (none(known)) return Real(0);
  const Vec from = seen_by_pane(scene, at, light, via, known);
  const LightSample seen = meet_light(scene, place, probe_ray(from, d, at.time), known);
  return pdf_light(scene, place, from, at.time, d, seen.distance, seen.n, seen.valid);
}

LIGHTBENCH_KERNEL_END
