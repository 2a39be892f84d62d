#pragma once
// Spheres of clear glass, through which lights are sampled too. A ray that is refracted into a
// sphere and out of it leaves at the impact parameter that it came with, so its way to a light is
// one equation in one unknown: a ray from distance D of the centre that meets the sphere of radius
// R at incidence theta, s = sin(theta), goes on to a point at distance D' if the directions to the
// centre and from the centre to that point differ by
//   g(s) = 2 asin(s) - 2 asin(s / ior) - asin(s R / D) - asin(s R / D'),
// to the far side of the axis for positive s. Up to three s solve it for one point; those between
// the angles that bound a light are the images of the light in the sphere. Here g is tabulated, and
// directions are sampled evenly from all images' bounds. The bounds are only roughly the images':
// the density of the directions is exact, and what they miss is left to the paths' own rays.

#include "core/accel/hit_surface.h"
#include "core/lights/chooser.h"
#include "core/lights/glass_way.h"
#include "core/materials/dielectric.h"

LIGHTBENCH_KERNEL_BEGIN

struct Lens {
  Sphere sphere;
  Real ior;
  GlassBody body;
};
inline Lens lens_at(const auto& row, Real time) {
  return {{madd(row.vec(3), time, row.vec(0)), row[6], {}, {}},
          row[7],
          {row[8], row[9], row.vec(10), row[13]}};
}
/// Each active lane's own, whose number comes after those of the faces.
inline Lens lenses_of(const SceneView<T>& scene, Int via, Real time, Mask active) {
  return lens_at(
      merged_rows<kLensStride>(
          via, active,
          [&](std::uint32_t i) { return scene.lenses + (i - scene.face_count) * kLensStride; }),
      time);
}

/// sin(j pi / 16): where g is tabulated.
inline constexpr T kLensSine[kLensNodes + 1] = {T(0),
                                                T(0.195090322016128268),
                                                T(0.382683432365089772),
                                                T(0.555570233019602225),
                                                T(0.707106781186547524),
                                                T(0.831469612302545237),
                                                T(0.923879532511286756),
                                                T(0.980785280403230449),
                                                T(1)};

/// asin of 0 .. 1 to 7e-5 (Abramowitz & Stegun 4.4.45).
inline Real rough_asin(Real x) {
  const Real p = fma(fma(fma(x, T(-0.0187293), T(0.0742610)), x, T(-0.2121144)), x, T(1.5707288));
  return T(1.57079632679489662) - safe_sqrt(Real(1) - x) * p;
}

/// Directions from a point to the images of a light in a sphere: bounds of s on either side of the
/// axis, and of the angle around the axis.
struct LensView {
  Vec axis, to_light, across;  ///< orthonormal; the light is on the side of `to_light`
  Real k;                      ///< R / D
  Real half, cos_half;         ///< of the angle around the axis
  Real low[2 * kLensNodes], high[2 * kLensNodes];  ///< of s; first on the far side, then the near
  Real total;                                      ///< sum of the differences of their squares
  Mask outside;
};

/// `c` is a candidate's row (core/lights/light_choice.h).
inline LensView view_through(const Lens& lens, const auto& c, Vec from) {
  LensView v;
  const Vec a = lens.sphere.center - from, l = c.vec(0) - lens.sphere.center, n = c.vec(3);
  const Real d2 = length_squared(a), l2 = length_squared(l), r = lens.sphere.radius;
  v.outside = d2 > r * r * T(1.0001);
  const Real inverse = Real(1) / sqrt(max(d2, r * r)), inverse_l = Real(1) / sqrt(l2);
  v.axis = a * inverse;
  v.k = min(r * inverse, Real(1));
  const Real cosine = dot(v.axis, l) * inverse_l;
  const Vec beside = madd(v.axis, -dot(v.axis, l), l);
  const Real height2 = length_squared(beside);
  const Mask aside = height2 > l2 * T(1e-8);
  v.to_light =
      select(aside, beside * (Real(1) / sqrt(select(aside, height2, Real(1)))), Frame(v.axis).x);
  v.across = cross(v.axis, v.to_light);
  const Real sine = sqrt(height2) * inverse_l;
  // How far the light reaches across its direction from the centre.
  const Vec turned = v.to_light * cosine - v.axis * sine;
  const Real up = c[6] * safe_sqrt(Real(1) - square(dot(n, turned)));
  const Real side = c[6] * safe_sqrt(Real(1) - square(dot(n, v.across)));
  const Real angle = acos(cosine), reach = min(up * inverse_l, Real(1));
  const Real around = side * inverse_l / max(sine, Real(T(1e-6)));
  const Mask ahead = around >= Real(1) || angle <= reach;
  v.half = select(ahead, Real(kPi), rough_asin(min(around, Real(1))));
  v.cos_half = select(ahead, Real(-2), safe_sqrt(Real(1) - around * around));
  const Real b0 = select(ahead, Real(0), angle - reach), b1 = angle + reach;
  v.total = Real(0);
  Real g0(0);
  for (unsigned j = 0; j < kLensNodes; ++j) {
    const Real g1 = c[11 + j] - rough_asin(v.k * kLensSine[j + 1]);
    const Real step = g1 - g0;
    const Real slope = Real(1) / select(abs(step) > Real(T(1e-6)), step, Real(T(1e-6)));
    const T s = kLensSine[j], width = kLensSine[j + 1] - kLensSine[j];
    const auto cut = [&](unsigned side_of, Real from_g, Real to_g) {
      const Real x = (from_g - g0) * slope, y = (to_g - g0) * slope;
      const Real low = fma(clamp(min(x, y), Real(0), Real(1)), width, s);
      const Real high = fma(clamp(max(x, y), Real(0), Real(1)), width, s);
      v.low[side_of + j] = low;
      v.high[side_of + j] = high;
      v.total += (high - low) * (high + low);
    };
    cut(0, b0, b1);
    cut(kLensNodes, -b1, -b0);
    g0 = g1;
  }
  v.outside = v.outside && v.total > Real(0);
  return v;
}

/// 1 over the solid angle of the bounds, at the cosine from the axis.
inline Real pdf_at(const LensView& v, Real cosine) {
  return cosine / (v.k * v.k * v.total * v.half);
}

/// A direction evenly from the bounds.
inline Vec sample_view(const LensView& v, Vec2 u, Real& pdf) {
  const Real wanted = u.x * v.total;
  Real before(0), square_of_s(0);
  Mask near(false);
  for (unsigned j = 0; j < 2 * kLensNodes; ++j) {
    const Real lower = v.low[j] * v.low[j], upper = v.high[j] * v.high[j];
    const Mask m = wanted >= before && upper > lower;
    square_of_s = select(m, lower + (wanted - before), square_of_s);
    near = select(m, Mask(j >= kLensNodes), near);
    before += (v.high[j] - v.low[j]) * (v.high[j] + v.low[j]);
  }
  const Real sine = v.k * safe_sqrt(min(square_of_s, Real(1)));
  const Real cosine = safe_sqrt(Real(1) - sine * sine);
  Real s, c;
  sincos((u.y * T(2) - T(1)) * v.half, s, c);
  pdf = pdf_at(v, cosine);
  return madd(v.axis, cosine, madd(v.to_light, sine * select(near, c, -c), v.across * (sine * s)));
}

/// Density with which that gives unit direction d.
inline Real pdf_view(const LensView& v, Vec d) {
  const Real cosine = dot(d, v.axis), up = dot(d, v.to_light), side = dot(d, v.across);
  const Real sine = sqrt(up * up + side * side);
  const Real s = sine / v.k;
  Mask inside(false);
  for (unsigned j = 0; j < 2 * kLensNodes; ++j) {
    const Real toward = j < kLensNodes ? -up : up;
    inside = inside || (s >= v.low[j] && s < v.high[j] && toward >= v.cos_half * sine);
  }
  return select(inside && v.outside && cosine > Real(0), pdf_at(v, cosine), Real(0));
}

inline GlassWay way_through(const Lens& lens, Vec from, Vec d) {
  GlassWay w;
  const SphereHit hit = hit_sphere(lens.sphere, probe_ray(from, d), HitQuality::Refined);
  w.t = hit.span.near;
  w.n_in = normal_at(hit, d, w.t);
  w.p_in = madd(w.n_in, lens.sphere.radius, lens.sphere.center);
  const Real cosine = min(-dot(d, w.n_in), Real(1)), inverse = Real(1) / lens.ior;
  w.valid = hit.span.hit && w.t > Real(0) && cosine > Real(0);
  Real beyond;
  const Real passing = Real(1) - fresnel_dielectric(cosine, lens.ior, beyond);
  w.passing = passing * passing;
  w.d = normalize(madd(w.n_in, fma(cosine, inverse, -beyond), d * inverse));
  const Real through = -dot(w.d, w.n_in);
  w.chord = T(2) * through * lens.sphere.radius;
  w.n_out = normalize(madd(w.d, T(2) * through, w.n_in));
  w.p_out = madd(w.n_out, lens.sphere.radius, lens.sphere.center);
  w.d_out = normalize(madd(w.n_out, fma(-lens.ior, through, cosine), w.d * lens.ior));
  return w;
}

/// A lens as a point sees it that chooses.
struct LensPlace {
  Vec axis;
  Real k, receiver;  ///< R / D; mean height over the point's horizon over D
};
inline LensPlace place_of(const Lens& lens, const Chooser& at) {
  const Vec a = lens.sphere.center - at.p;
  const Real r = lens.sphere.radius, d2 = length_squared(a);
  const Real inverse = Real(1) / sqrt(max(d2, r * r));
  const Real height = clipped_height(dot(at.n, a), r, T(0.25) / r) * inverse;
  return {a * inverse, select(d2 > r * r * T(1.0001), r * inverse, Real(0)),
          select(looks_all_around(at), Real(1), height)};
}

/// The irradiance that a light sheds on the point through the lens, in the measure of
/// contribution(); `c` is the candidate's row, `candidate` its number.
inline Real contribution_through(const SceneView<T>& scene, const Lens& lens,
                                 const LensPlace& place, const auto& c, Int candidate) {
  const Real cosine = dot(place.axis, c.vec(0) - lens.sphere.center) * c[10];
  const Real half_sine = safe_sqrt(fma(cosine, T(-0.5), Real(T(0.5))));
  const Int row = to_int(min(place.k * T(kLensNearness), Real(T(kLensNearness - 1))));
  const Int column = to_int(min(half_sine * T(kLensAngles), Real(T(kLensAngles - 1))));
  const Int cell = (candidate - Int(scene.first_lens_candidate)) * Int(kLensCells) +
                   row * Int(kLensAngles) + column;
  return select(place.k > Real(0), gather(scene.lens_tables, cell), Real(0)) * place.receiver;
}

/// Which lens `primitive` is; kStraight for none.
inline Int lens_of(const SceneView<T>& scene, Int primitive, Mask active) {
  Int lens(kStraight);
  for (std::uint32_t i = 0; i < scene.lens_count; ++i) {
    const Mask m =
        active && primitive == Int(static_cast<std::uint32_t>(scene.lenses[i * kLensStride + 8]));
    lens = select(m, Int(scene.face_count + i), lens);
  }
  return lens;
}

LIGHTBENCH_KERNEL_END
