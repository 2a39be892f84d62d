#pragma once
// Which light a point samples. Where the scene has few lights, in proportion to an estimate of what
// each would bring to that very point; and then the images of the lights in plane mirrors and
// through glass boxes and spheres are lights too. Where it has many, by the same estimate of whole
// clusters of them (core/lights/light_tree.h). One light alone needs no choice; an alias table by
// power serves it.
//
// The estimate only has to be positive where it matters: the probability that it leads to takes
// part in the weights of multiple importance sampling, so a light judged 0 is left to the paths'
// own rays.

#include <algorithm>

#include "core/kernel/uses.h"
#include "core/lights/chooser.h"
#include "core/lights/face.h"
#include "core/lights/lens.h"
#include "core/lights/light_tree.h"
#include "core/sampling/sobol.h"

LIGHTBENCH_KERNEL_BEGIN

/// By power: 32 random bits; scene.light_count > 0.
inline LightChoice choose_by_power(const SceneView<T>& scene, Int random) {
  if (scene.light_count == 1) return {Int(0U), Int(kStraight), Real(1), unit_from_bits(random)};
  const Int i = scale_bits(random, scene.light_count);
  // The low half of the product is the position within the bin.
  const Real u = unit_from_bits(random * Int(scene.light_count));
  const T spacing = std::max(kUnitSpacing, static_cast<T>(scene.light_count) * T(0x1p-32));
  const Real threshold = gather(scene.alias_threshold, i);
  const Mask keep = u < threshold;
  const Int light = select(keep, i, gather(scene.alias_other, i));
  return {light, Int(kStraight), gather(scene.light_pmf, light),
          stretched(select(keep, u, u - threshold), select(keep, threshold, Real(1) - threshold),
                    unit_from_bits(hash(random)) * spacing)};
}

/// The irradiance that candidate `c` of the table sheds on the point if nothing is in the way, but
/// for factors common to all. `c` reads a row (Row or LaneRow):
///   0..2 centre, 3..5 normal (0 for solids), 6 radius, 7 emitted luminance times area seen from
///   the front, 8 light, 9 face or -1, 10 kOneSided, kTwoSided or kSolid, 11..17 its window
///   (core/lights/face.h), 18 a quarter of the inverse of its radius.
/// Seen through a lens (core/lights/lens.h) instead: 10 the inverse of its distance from the lens,
///   11..18 the light's part of g at the nodes.
/// Of an image in a mirror the centre and the normal are mirrored; of one through a pane the centre
/// is where a ray at right angles to the pane would see it. The cosine at the point is the
/// mean of the clipped heights within the radius; d^2 + r^2 makes it exact for a disc over the
/// point.
inline Real contribution(const auto& c, const Chooser& at) {
  const Vec d = c.vec(0) - at.p;
  const Real r = c[6], rr = r * r;
  const Real d2 = max(length_squared(d), rr * T(1e-4)), sum = d2 + rr;
  const Real falloff = Real(1) / (d2 * sum);
  Real receiver = clipped_height(dot(at.n, d), r, c[18]), height(0);
  const Mask flat = c.below(10, kSolid), in_medium = looks_all_around(at);
  if (any(flat)) {
    height = -dot(c.vec(3), d);
    height = select(c.below(10, kTwoSided), height, abs(height));
    // Near a flat light its far parts are seen less steeply than its centre.
    height = select(height > Real(0), fma(r, min(rr * sum * falloff, Real(1)), height), Real(0));
  }
  if (any(!flat || in_medium)) {
    const Real distance = sqrt(d2);
    height = select(flat, height, distance);
    receiver = select(in_medium, distance, receiver);
  }
  return c[7] * receiver * height * falloff;
}

/// Of the candidates from number i on. Out of line: most scenes have none.
[[gnu::noinline]] inline void add_lens_contributions(const SceneView<T>& scene, const Chooser& at,
                                                     std::uint32_t i, Contributions& c) {
  for (std::uint32_t l = 0; l < scene.lens_count; ++l) {
    const Lens lens = lens_at(Row{scene.lenses + l * kLensStride}, at.time);
    const LensPlace place = place_of(lens, at);
    for (; i < scene.lens_end[l]; ++i) {
      const Row row{scene.light_candidates + i * kLightCandidateStride};
      c.of[i] = contribution_through(scene, lens, place, row, Int(i));
      c.total += c.of[i];
    }
  }
}
inline Contributions contributions(const SceneView<T>& scene, const Chooser& at) {
  Contributions c;
  c.total = Real(0);
  for (std::uint32_t i = 0; i < scene.direct_candidates; ++i) {
    c.of[i] = contribution(Row{scene.light_candidates + i * kLightCandidateStride}, at);
    c.total += c.of[i];
  }
  std::uint32_t i = scene.direct_candidates;
  const bool images = uses(scene, Feature::ImagesInMirrors) || uses(scene, Feature::ImagesInPanes);
  const std::uint32_t faces = images ? scene.face_count : 0;
  for (std::uint32_t f = 0; f < faces; ++f) {
    const Face face = face_at(Row{scene.faces + f * kFaceStride});
    const Vec place = place_before(face, at.p);
    for (; i < scene.face_end[f]; ++i) {
      const Row row{scene.light_candidates + i * kLightCandidateStride};
      const Real seen = share_in_window(face, place, row);
      c.of[i] = Real(0);
      if (none(seen > Real(0))) continue;
      c.of[i] = contribution(row, at) * seen;
      c.total += c.of[i];
    }
  }
  if (uses(scene, Feature::ImagesInGlass)) add_lens_contributions(scene, at, i, c);
  return c;
}

/// By contribution: 32 random bits; candidates exist. `scale` = 1 / the sum of all, or 0. Out of
/// line, for registers: with 16 of them it is 1.046 times as fast, with 32 .99.
[[gnu::noinline]] inline LightChoice choose_by_contribution(const SceneView<T>& scene,
                                                            const Chooser& at, Int random,
                                                            Real& scale) {
  const Contributions c = contributions(scene, at);
  LightChoice choice{Int(0U), Int(kStraight), Real(0), Real(0)};
  const Real u = unit_from_bits(random);
  const Picked picked = pick(c, u, scene.candidate_count, [&](std::uint32_t i, Mask m) {
    const T* row = scene.light_candidates + i * kLightCandidateStride;
    choice.light = select(m, Int(static_cast<std::uint32_t>(row[8])), choice.light);
    choice.via = select(m, Int(via_of(row[9])), choice.via);
  });
  scale = select(c.total > Real(0), Real(1) / c.total, Real(0));
  choice.pmf = picked.value * scale;
  // The bits that u is too short for.
  const Real fill = unit_from_bits(random << 24) * kUnitSpacing;
  choice.rest = stretched(u * c.total - picked.before, picked.value, fill * c.total);
  return choice;
}

/// Number of the candidate that `light` is by way of a face or lens; kNoLight for none.
inline Int candidate_of(const SceneView<T>& scene, Int light, Int via, Mask active) {
  return gather(scene.image_candidate,
                select(active, via * Int(scene.light_count) + light, Int(0U)));
}

/// Each active lane's own row.
inline auto candidates_of(const SceneView<T>& scene, Int candidate, Mask active) {
  return merged_rows<kLightCandidateStride>(candidate, active, [&](std::uint32_t i) {
    return scene.light_candidates + i * kLightCandidateStride;
  });
}

/// Probability with which the point chose, or would have chosen, `light` by way of `via` (kStraight
/// for itself), by the `scale` that its choice gave.
inline Real pmf_by_contribution(const SceneView<T>& scene, const Chooser& at, Int light, Int via,
                                Real scale, Mask active) {
  const Mask image = active && via != Int(kStraight);
  Int candidate = light;
  if (any(image)) candidate = select(image, candidate_of(scene, light, via, image), candidate);
  const Mask known = active && candidate != Int(kNoLight);
  if (none(known)) return Real(0);
  const auto row = candidates_of(scene, candidate, known);
  Real value = contribution(row, at);
  const Mask seen = known && image, through = seen && is_lens(scene, via);
  if (uses(scene, Feature::ImagesInGlass) && any(through)) {
    const Lens lens = lenses_of(scene, via, at.time, through);
    const Int some = select(through, candidate, Int(scene.first_lens_candidate));
    value =
        select(through, contribution_through(scene, lens, place_of(lens, at), row, some), value);
  }
  const Mask in_face = seen && !through;
  if (any(in_face)) {
    const Face f = faces_of(scene, via, in_face);
    value = select(in_face, value * share_in_window(f, place_before(f, at.p), row), value);
  }
  return select(known, value * scale, Real(0));
}

/// What `at` sees of the light through the lens; the pair has a candidate in all active lanes.
inline LensView lens_view(const SceneView<T>& scene, const Lens& lens, const Chooser& at, Int light,
                          Int via, Mask active) {
  const Int candidate = candidate_of(scene, light, via, active);
  return view_through(lens, candidates_of(scene, candidate, active), at.p);
}

/// Density of direction d for a point that has chosen the light through the lens; 0 where that has
/// no candidate.
[[gnu::noinline]] inline Real pdf_through(const SceneView<T>& scene, const Chooser& at, Int light,
                                          Int via, Vec d, Mask active) {
  const Mask known = active && candidate_of(scene, light, via, active) != Int(kNoLight);
  if (none(known)) return Real(0);
  const Lens lens = lenses_of(scene, via, at.time, known);
  return select(known, pdf_view(lens_view(scene, lens, at, light, via, known), d), Real(0));
}

/// True where lights are sampled by other ways than the straight one.
inline bool has_detours(const SceneView<T>& scene) {
  return uses(scene, Feature::ImagesInMirrors) || uses(scene, Feature::ImagesInPanes) ||
         uses(scene, Feature::ImagesInGlass);
}

/// True where the choice depends on the point, which paths then remember.
inline bool point_chooses(const SceneView<T>& scene) {
  return uses(scene, Feature::ChoiceOfLights) || uses(scene, Feature::LightTree);
}

/// The scene's way of choosing, by 32 random bits; the scene must have lights. `scale` is what
/// pmf_of_light() wants to know of the choice.
inline LightChoice choose_light(const SceneView<T>& scene, const Chooser& at, Int random,
                                Mask active, Real& scale) {
  scale = Real(1);
  if (uses(scene, Feature::ChoiceOfLights)) return choose_by_contribution(scene, at, random, scale);
  if (uses(scene, Feature::LightTree)) return choose_by_tree(scene, at, random, active, scale);
  return choose_by_power(scene, random);
}

/// Probability with which the point chose, or would have chosen, `light` by way of `via` (kStraight
/// for itself); 0 where !active.
inline Real pmf_of_light(const SceneView<T>& scene, const Chooser& at, Int light, Int via,
                         Real scale, Mask active) {
  if (uses(scene, Feature::ChoiceOfLights))
    return pmf_by_contribution(scene, at, light, via, scale, active);
  if (uses(scene, Feature::LightTree)) return pmf_by_tree(scene, at, light, scale, active);
  return select(active, gather(scene.light_pmf, select(active, light, Int(0U))), Real(0));
}

LIGHTBENCH_KERNEL_END
