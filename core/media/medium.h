#pragma once
// Constant media. A boundary is a closed shape; the stretches that a ray spends inside it come from
// the shape's own interval, so a ray may start anywhere and media may overlap (each is an
// independent process, as in the books) without any bookkeeping along the path.

#include "core/accel/mesh_hit.h"
#include "core/accel/primitive_hit.h"
#include "core/sampling/dimensions.h"

LIGHTBENCH_KERNEL_BEGIN

/// Calls f(enter, exit) for each stretch of (0, t_max) inside mesh boundary i, in order; f returns
/// true to stop.
template <class F>
void mesh_stretches(const SceneView<T>& scene, std::uint32_t i, const SingleRay& world, T t_max,
                    F f) {
  SingleRay ray = to_mesh_space(scene, i, world);
  const MeshView<T>& mesh = mesh_of(scene, i);
  T from = 0;
  while (true) {
    const MeshHit h = hit_mesh(mesh, ray, from, T(kInfinity));
    if (!h.found) return;
    const TriangleBlock<T>& block = mesh.blocks[h.slot / kBvhWidth];
    const std::uint32_t c = h.slot % kBvhWidth;
    T e1[3], e2[3];
    for (unsigned a = 0; a < 3; ++a) {
      e1[a] = block.v[3 + a][c] - block.v[a][c];
      e2[a] = block.v[6 + a][c] - block.v[a][c];
    }
    const T facing = (e1[1] * e2[2] - e1[2] * e2[1]) * ray.d[0] +
                     (e1[2] * e2[0] - e1[0] * e2[2]) * ray.d[1] +
                     (e1[0] * e2[1] - e1[1] * e2[0]) * ray.d[2];
    const T end = h.t < t_max ? h.t : t_max;
    if (facing > 0 && end > from && f(from, end)) return;
    if (h.t >= t_max) return;
    from = h.t;
    ray.from_slot = h.slot;
  }
}

/// Where a medium scatters the ray before t_max.
struct MediumHit {
  Real t;
  Vec albedo;
  Mask scattered;
};

/// Free flight through all media of the scene.
inline MediumHit sample_media(const SceneView<T>& scene, const Ray& ray, Real t_max,
                              const Sampler& sampler, Int vertex, Mask active) {
  MediumHit hit{t_max, Vec(Real(1)), Mask(false)};
  for (std::uint32_t k = 0; k < scene.medium_count; ++k) {
    const MediumView<T>& medium = scene.media[k];
    const Real flight = exponential(flight_number(sampler, vertex, k)) / medium.sigma;
    Real t(kInfinity);
    if (scene.kind[medium.boundary] != static_cast<std::uint32_t>(PrimitiveKind::Mesh)) {
      const Interval s = solid_interval(scene, medium.boundary, ray);
      const Real enter = max(s.near, Real(0));
      t = select(s.hit && enter + flight < s.far, enter + flight, t);
    } else {
      alignas(64) T remaining[kLanes], limit[kLanes], at[kLanes];
      store(remaining, flight);
      store(limit, hit.t);
      store(at, t);
      const RayTable rays(ray);
      for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(m));
        mesh_stretches(scene, medium.boundary, rays.single(lane), limit[lane],
                       [&](T enter, T exit) {
                         if (remaining[lane] < exit - enter) {
                           at[lane] = enter + remaining[lane];
                           return true;
                         }
                         remaining[lane] -= exit - enter;
                         return false;
                       });
      }
      t = load(at);
    }
    const Mask closer = active && t < hit.t;
    hit.t = select(closer, t, hit.t);
    hit.albedo =
        select(closer, Vec{Real(medium.albedo[0]), Real(medium.albedo[1]), Real(medium.albedo[2])},
               hit.albedo);
    hit.scattered = hit.scattered || closer;
  }
  return hit;
}

/// Share of light that passes from the ray's origin to distance t_max.
inline Real transmittance(const SceneView<T>& scene, const Ray& ray, Real t_max, Mask active) {
  Real optical_depth(0);
  for (std::uint32_t k = 0; k < scene.medium_count; ++k) {
    const MediumView<T>& medium = scene.media[k];
    if (scene.kind[medium.boundary] != static_cast<std::uint32_t>(PrimitiveKind::Mesh)) {
      const Interval s = solid_interval(scene, medium.boundary, ray);
      const Real inside = max(min(s.far, t_max) - max(s.near, Real(0)), Real(0));
      optical_depth = fma(select(s.hit, inside, Real(0)), Real(medium.sigma), optical_depth);
    } else {
      alignas(64) T inside[kLanes] = {}, limit[kLanes];
      store(limit, t_max);
      const RayTable rays(ray);
      for (std::uint32_t m = bits(active); m != 0; m &= m - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(m));
        mesh_stretches(scene, medium.boundary, rays.single(lane), limit[lane],
                       [&](T enter, T exit) {
                         inside[lane] += exit - enter;
                         return false;
                       });
      }
      optical_depth = fma(load(inside), Real(medium.sigma), optical_depth);
    }
  }
  return exp(-optical_depth);
}

LIGHTBENCH_KERNEL_END
