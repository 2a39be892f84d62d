#pragma once
// Ways of light samples that are not straight: by a plane mirror, or through a sphere of glass.

#include "core/lights/light.h"
#include "core/lights/light_choice.h"

LIGHTBENCH_KERNEL_BEGIN

/// From the vertex for `t` along d to what the way goes by, then from `origin` along the light
/// sample's own direction for `rest`; through a lens that something may reach into, before that for
/// `chord` along `within` from `inner`. Meaningful where `taken`.
struct Detour {
  Mask taken, crowded;
  Int by;  ///< primitive
  Vec d, within, inner, origin;
  Real t, chord, rest;
  Vec color;     ///< share of the light that it lets pass
  Real passing;  ///< probability with which a path of its own that leaves along d follows
};
inline Detour straight_on() {
  const Vec zero(Real(0));
  return {Mask(false), Mask(false), Int(kNoHit), zero,    zero,         zero,
          zero,        Real(0),     Real(0),     Real(0), Vec(Real(1)), Real(1)};
}

/// In the lanes of `m` the sample came from the point behind the mirror.
inline void take_mirror(const SceneView<T>& scene, Int via, Mask m, Vec from, LightSample& s,
                        Detour& way) {
  const Mirror mirror = mirrors_of(scene, via, m);
  const Vec d = mirrored_direction(mirror, s.d);
  const Real t = place_before(mirror, from).z / dot(mirror.n, s.d);
  const Vec p = madd(d, t, from), at = place_before(mirror, p);
  const Mask meets = t > Real(0) && t < s.distance && within_outline(mirror, at.x, at.y);
  s.valid = s.valid && (!m || meets);
  way.taken = way.taken || m;
  way.by = select(m, to_int(mirror.primitive), way.by);
  way.d = select(m, d, way.d);
  way.t = select(m, t, way.t);
  way.origin = select(m, leave_surface(p, mirror.n, mirror.offset), way.origin);
  way.rest = select(m, s.distance - t, way.rest);
  way.color = select(m, mirror.color, way.color);
}

/// Samples the chosen lights through lenses, in the lanes of `m`. Out of line: most scenes have no
/// lens.
[[gnu::noinline]] inline void take_lens(const SceneView<T>& scene, const Chooser& at,
                                        const LightChoice& chosen, LightPlace place, Vec2 u, Mask m,
                                        LightSample& s, Detour& way) {
  const Lens lens = lenses_of(scene, chosen.via, at.time, m);
  const LensView view = lens_view(scene, lens, at, chosen.light, chosen.via, m);
  Real pdf;
  const Vec d = sample_view(view, u, pdf);
  const LensWay through = way_through(lens, at.p, d);
  const Vec p = madd(through.out, lens.sphere.radius, lens.sphere.center);
  const Vec origin = leave_surface(p, through.out, lens.offset);
  const Mask met = m && view.outside && through.valid;
  s.valid = s.valid && !m;
  if (none(met)) return;
  LightSample beyond = meet_light(scene, place, probe_ray(origin, through.d_out, at.time), met);
  beyond.pdf = pdf;
  s = select(m, beyond, s);
  way.taken = way.taken || m;
  way.crowded = m && lens.crowded > Real(0);
  way.by = select(m, to_int(lens.primitive), way.by);
  way.d = select(m, d, way.d);
  way.t = select(m, through.t, way.t);
  way.within = through.d;
  way.inner = leave_surface(madd(through.in, lens.sphere.radius, lens.sphere.center), -through.in,
                            lens.offset);
  way.chord = through.chord;
  way.origin = select(m, origin, way.origin);
  way.rest = select(m, s.distance, way.rest);
  way.color = select(m, lens.tint * through.passing, way.color);
  way.passing = select(m, through.passing, way.passing);
}

LIGHTBENCH_KERNEL_END
