#pragma once
// Camera rays: pixel filter, thin lens, shutter.

#include "core/kernel/uses.h"
#include "core/sampling/dimensions.h"
#include "core/shapes/shape.h"

LIGHTBENCH_KERNEL_BEGIN

/// Offset from the pixel's centre, in pixels, distributed as the filter: every sample then counts
/// fully and for its own pixel only (filter importance sampling, Ernst et al. 2006).
inline Vec2 sample_filter(const CameraView<T>& camera, Vec2 u) {
  const Real r(camera.filter_radius);
  switch (camera.filter) {
    case 1: {  // triangle: the sum of two uniforms per axis, by its inverse
      const auto tent = [](Real x) {
        const Real low = sqrt(T(2) * x) - Real(1), high = Real(1) - sqrt(T(2) * (Real(1) - x));
        return select(x < Real(T(0.5)), low, high);
      };
      return {r * tent(u.x), r * tent(u.y)};
    }
    case 2: {  // Gaussian of sigma = radius / 2, cut off at the radius, by its radial inverse
      const Real covered(T(0.8646647167633873));  // 1 - exp(-2)
      const Real radius = r * T(0.5) * sqrt(T(-2) * log(Real(1) - u.x * covered));
      Real s, c;
      sincos(u.y * kTwoPi, s, c);
      return {radius * c, radius * s};
    }
    default:
      return {r * (u.x * T(2) - T(1)), r * (u.y * T(2) - T(1))};
  }
}

/// Ray through picture position (x, y) in pixels, y down. Times run from 0 to 1 over the shutter:
/// compile() bakes opening and closing into the motion.
inline Ray camera_ray(const SceneView<T>& scene, Real x, Real y, const Sampler& sampler) {
  const CameraView<T>& camera = scene.camera;
  const auto vec = [](const T(&v)[3]) { return Vec{Real(v[0]), Real(v[1]), Real(v[2])}; };
  const Real sx = x * (T(2) / static_cast<T>(camera.width)) - T(1);
  const Real sy = Real(1) - y * (T(2) / static_cast<T>(camera.height));
  Ray ray;
  ray.o = vec(camera.origin);
  ray.d = madd(vec(camera.right), sx, madd(vec(camera.up), sy, vec(camera.forward)));
  if (uses(scene, Feature::Lens)) {
    const Vec2 lens = square_to_disk(lens_numbers(sampler));
    // right and up are as long as half the picture at distance 1; the lens wants them unit.
    const Vec offset = normalize(vec(camera.right)) * (lens.x * camera.lens_radius) +
                       normalize(vec(camera.up)) * (lens.y * camera.lens_radius);
    // Towards the same point at the focus distance, in the form that a vanishing lens leaves alone.
    ray.d = madd(offset, Real(T(-1) / camera.focus_distance), ray.d);
    ray.o = ray.o + offset;
  }
  ray.d = normalize(ray.d);
  ray.time = uses(scene, Feature::Motion) ? time_number(sampler) : Real(0);
  ray.from = ray.from_slot = ray.skip = ray.skip_slot = Int(kNoHit);
  ray.inside = ray.skip_back = false;
  return ray;
}

LIGHTBENCH_KERNEL_END
