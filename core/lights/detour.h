#pragma once
// Ways of light samples that are not straight: by a plane mirror, or through a sphere or a box of
// glass.

#include "core/lights/light.h"
#include "core/lights/light_choice.h"
#include "core/lights/pane.h"

LIGHTBENCH_KERNEL_BEGIN

/// From the vertex for `t` along d to what the way goes by, then from `origin` along the light
/// sample's own direction for `rest`; through glass that something may reach into, before that for
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
  const Face mirror = faces_of(scene, via, m);
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

/// In the lanes of `m`, whose directions were sampled with density `pdf`, the sample is what the
/// light beyond the glass shows of itself; `through` is the way to there.
inline void take_glass(const SceneView<T>& scene, const GlassBody& body, const GlassWay& through,
                       LightPlace place, Vec d, Real pdf, Real time, Mask m, LightSample& s,
                       Detour& way) {
  const Vec origin = leave_surface(through.p_out, through.n_out, body.offset);
  const Mask met = m && through.valid;
  s.valid = s.valid && !m;
  if (none(met)) return;
  LightSample beyond = meet_light(scene, place, probe_ray(origin, through.d_out, time), met);
  beyond.pdf = pdf;
  s = select(m, beyond, s);
  way.taken = way.taken || m;
  way.crowded = way.crowded || (m && body.crowded > Real(0));
  way.by = select(m, to_int(body.primitive), way.by);
  way.d = select(m, d, way.d);
  way.t = select(m, through.t, way.t);
  way.within = select(m, through.d, way.within);
  way.inner = select(m, leave_surface(through.p_in, -through.n_in, body.offset), way.inner);
  way.chord = select(m, through.chord, way.chord);
  way.origin = select(m, origin, way.origin);
  way.rest = select(m, s.distance, way.rest);
  way.color = select(m, body.tint * through.passing, way.color);
  way.passing = select(m, through.passing, way.passing);
}

/// In the lanes of `m` the sample came from where the point seems to be through the pane. Out of
/// line, as the next: most scenes have no glass.
[[gnu::noinline]] inline void take_pane(const SceneView<T>& scene, const Chooser& at, Int via,
                                        LightPlace place, Mask m, LightSample& s, Detour& way) {
  m = m && s.valid;
  const Face pane = faces_of(scene, via, m);
  take_glass(scene, {pane.primitive, pane.offset, pane.color, pane.crowded},
             way_through(pane, at.p, s.d), place, s.d, s.pdf, at.time, m, s, way);
}

/// Samples the chosen lights through lenses, in the lanes of `m`.
[[gnu::noinline]] inline void take_lens(const SceneView<T>& scene, const Chooser& at,
                                        const LightChoice& chosen, LightPlace place, Vec2 u, Mask m,
                                        LightSample& s, Detour& way) {
  const Lens lens = lenses_of(scene, chosen.via, at.time, m);
  const LensView view = lens_view(scene, lens, at, chosen.light, chosen.via, m);
  Real pdf;
  const Vec d = sample_view(view, u, pdf);
  GlassWay through = way_through(lens, at.p, d);
  through.valid = through.valid && view.outside;
  take_glass(scene, lens.body, through, place, d, pdf, at.time, m, s, way);
}

LIGHTBENCH_KERNEL_END
