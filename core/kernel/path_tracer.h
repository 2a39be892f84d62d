#pragma once
// Unidirectional path tracing with next-event estimation and multiple importance sampling (power
// heuristic). One path per lane, advanced one vertex at a time; a lane whose path ends takes the
// next (pixel, sample) at once, so lanes never idle while work is left.

#include "core/camera/camera.h"
#include "core/compile/render_scene.h"
#include "core/film/film.h"
#include "core/lights/environment.h"
#include "core/lights/light.h"
#include "core/materials/scatter.h"
#include "core/media/medium.h"

LIGHTBENCH_KERNEL_BEGIN

/// The state of the paths in flight.
struct Paths {
  Ray ray;
  Vec throughput, radiance;
  Real pdf;             ///< of the ray's direction, solid angle; 0 after the camera or a delta lobe
  Real roulette_scale;  ///< undoes the radiance scaling of refraction when judging a path's worth
  Int segments;         ///< path segments traced
  Int pixel;            ///< film index
  Int sample;
  Sampler sampler;
  Mask alive;
};

inline Paths select(Mask m, const Paths& a, const Paths& b) {
  Paths r;
  r.ray.o = select(m, a.ray.o, b.ray.o);
  r.ray.d = select(m, a.ray.d, b.ray.d);
  r.ray.time = select(m, a.ray.time, b.ray.time);
  r.ray.from = select(m, a.ray.from, b.ray.from);
  r.ray.from_slot = select(m, a.ray.from_slot, b.ray.from_slot);
  r.ray.inside = select(m, a.ray.inside, b.ray.inside);
  r.ray.skip = r.ray.skip_slot = Int(kNoHit);
  r.ray.skip_back = false;
  r.throughput = select(m, a.throughput, b.throughput);
  r.radiance = select(m, a.radiance, b.radiance);
  r.pdf = select(m, a.pdf, b.pdf);
  r.roulette_scale = select(m, a.roulette_scale, b.roulette_scale);
  r.segments = select(m, a.segments, b.segments);
  r.pixel = select(m, a.pixel, b.pixel);
  r.sample = select(m, a.sample, b.sample);
  r.sampler.pixel_key = select(m, a.sampler.pixel_key, b.sampler.pixel_key);
  r.sampler.reversed_index = select(m, a.sampler.reversed_index, b.sampler.reversed_index);
  r.alive = select(m, a.alive, b.alive);
  return r;
}

/// The samples of a Work, pixel by pixel, numbered 0 .. count - 1.
struct Jobs {
  const Work& work;
  int film_width;
  std::uint32_t next = 0, count;
  Jobs(const Work& w, int width)
      : work(w),
        film_width(width),
        count(static_cast<std::uint32_t>(w.x1 - w.x0) * static_cast<std::uint32_t>(w.y1 - w.y0) *
              w.sample_count) {}
};

/// Fresh paths in the lanes of `dead`, as far as jobs are left.
inline Paths start_paths(const SceneView<T>& scene, Jobs& jobs, Mask dead) {
  alignas(64) std::uint32_t xs[kLanes] = {}, ys[kLanes] = {}, samples[kLanes] = {},
                            pixels[kLanes] = {};
  std::uint32_t started = 0;
  const auto columns = static_cast<std::uint32_t>(jobs.work.x1 - jobs.work.x0);
  const auto stride = static_cast<std::uint32_t>(jobs.work.stride);
  for (std::uint32_t m = bits(dead); m != 0 && jobs.next < jobs.count; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    const std::uint32_t job = jobs.next++;
    const std::uint32_t cell = job / jobs.work.sample_count;
    samples[lane] = jobs.work.first_sample + job % jobs.work.sample_count;
    const std::uint32_t film_x = static_cast<std::uint32_t>(jobs.work.x0) + cell % columns;
    const std::uint32_t film_y = static_cast<std::uint32_t>(jobs.work.y0) + cell / columns;
    pixels[lane] = film_y * static_cast<std::uint32_t>(jobs.film_width) + film_x;
    // Of the picture: a window of it holds the very samples of the whole.
    xs[lane] = film_x * stride + static_cast<std::uint32_t>(scene.camera.crop_x);
    ys[lane] = film_y * stride + static_cast<std::uint32_t>(scene.camera.crop_y);
    started |= 1U << lane;
  }
  const CameraView<T>& camera = scene.camera;
  Paths p;
  p.sample = load(samples);
  p.pixel = load(pixels);
  const Int x = load(xs), y = load(ys);
  p.sampler.pixel_key = hash(hash(x, y), Int(scene.seed));
  p.sampler.reversed_index = reverse_bits(p.sample);
  const Vec2 u = p.sampler.pair(Int(dimension::kFilter));
  // Within a pixel by the filter; the quick look spreads evenly over the block a pixel stands for.
  const Vec2 offset =
      jobs.work.stride == 1 ? sample_filter(camera, u) : Vec2{u.x - T(0.5), u.y - T(0.5)};
  p.ray =
      camera_ray(camera, to_real(x) + (T(0.5) + offset.x) * static_cast<T>(jobs.work.stride),
                 to_real(y) + (T(0.5) + offset.y) * static_cast<T>(jobs.work.stride), p.sampler);
  p.throughput = Vec(Real(1));
  p.radiance = Vec(Real(0));
  p.pdf = Real(0);
  p.roulette_scale = Real(1);
  p.segments = Int(0U);
  p.alive = mask_from_bits(started);
  return p;
}

/// Adds the finished paths of `done` to the film. A sample that is not finite or beyond the film's
/// range is dropped and counted, with the place of the first.
inline void splat(const SceneView<T>& scene, const Paths& paths, Mask done, const Work& work,
                  FilmView film, Counters& counters) {
  alignas(64) T rgb[3][kLanes], luminances[kLanes];
  alignas(64) std::uint32_t pixels[kLanes], samples[kLanes], dither[kLanes];
  const Vec value = paths.radiance * Real(scene.inverse_film_unit);
  store(rgb[0], value.x);
  store(rgb[1], value.y);
  store(rgb[2], value.z);
  store(luminances, luminance(value));
  store(pixels, paths.pixel);
  store(samples, paths.sample);
  // Rounding up or down by chance, with a number of the sample's own, keeps means unbiased however
  // far they lie below the film's step.
  store(dither, hash(paths.sampler.pixel_key, paths.sample));
  constexpr auto kLimit = static_cast<T>(kFilmSampleLimit);
  constexpr auto kStep = static_cast<double>(std::int64_t{1} << kFilmBits);
  constexpr auto kSquareStep = static_cast<double>(std::int64_t{1} << kFilmSquareBits);
  for (std::uint32_t m = bits(done); m != 0; m &= m - 1) {
    const auto lane = static_cast<unsigned>(__builtin_ctz(m));
    ++counters.paths;
    const T r = rgb[0][lane], g = rgb[1][lane], b = rgb[2][lane];
    if (!(r >= T(0) && g >= T(0) && b >= T(0) && r <= kLimit && g <= kLimit && b <= kLimit)) {
      if (counters.non_finite++ == 0) {
        const auto width = static_cast<std::uint32_t>(film.width);
        counters.bad_x = static_cast<int>(pixels[lane] % width) * work.stride + scene.camera.crop_x;
        counters.bad_y = static_cast<int>(pixels[lane] / width) * work.stride + scene.camera.crop_y;
        counters.bad_sample = samples[lane];
      }
      continue;
    }
    FilmPixel& pixel = film.pixels[pixels[lane]];
    const double chance = dither[lane] * 0x1p-32;
    const auto steps = [chance](double x) { return static_cast<std::int64_t>(x + chance); };
    pixel.r += steps(static_cast<double>(r) * kStep);
    pixel.g += steps(static_cast<double>(g) * kStep);
    pixel.b += steps(static_cast<double>(b) * kStep);
    const auto y = static_cast<double>(luminances[lane]);
    const std::int64_t squared = steps(y * y * kSquareStep);
    // Saturating, which for sums of non-negative numbers does not depend on their order either.
    if (__builtin_add_overflow(pixel.luminance_squared, squared, &pixel.luminance_squared)) {
      pixel.luminance_squared = INT64_MAX;
    }
  }
}

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
  v.surface.p = v.surface.ng = v.surface.ns = v.surface.tangent = v.object_point = Vec(Real(0));
  v.material = black_material();
  v.offset = Real(0);
  for_each_distinct(hit.primitive, active, [&](std::uint32_t i, Mask m) {
    merge(m, surface_of(scene, i, ray, hit, m, scene.needs_uv), v.surface);
    merge(m, material_at(scene.materials + std::size_t{scene.material[i]} * kMaterialStride),
          v.material);
    v.offset = select(m, Real(scene.offset[i]), v.offset);
    if (scene.to_object != nullptr) {
      const Affine to_object = affine_at({scene.to_object + std::size_t{12} * i}, 0);
      v.object_point = select(m, to_object.point(v.surface.p), v.object_point);
    }
  });
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
    for_each_distinct(place.primitive, s.valid, [&](std::uint32_t i, Mask m) {
      const auto kind = static_cast<PrimitiveKind>(scene.kind[i]);
      if (kind != PrimitiveKind::Triangle && kind != PrimitiveKind::Mesh) return;
      const Triangle t = kind == PrimitiveKind::Mesh ? mesh_light(scene, i, place.slot, m).triangle
                                                     : triangle_at({scene.rows + scene.row[i]});
      const TriangleHit h = hit_triangle(t, shadow);
      hit.b1 = select(m, h.b1, hit.b1);
      hit.b2 = select(m, h.b2, hit.b2);
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

/// One light sample from each vertex of `active`, added to the paths' radiance.
inline void add_direct_light(const SceneView<T>& scene, const Vertex& v, const Frame& frame,
                             Int dimension_base, Mask active, Paths& paths, Counters& counters) {
  const LightChoice chosen =
      choose_light(scene, paths.sampler.pair_bits(dimension_base + Int(dimension::kChoice)).x);
  const LightPlace place = place_of(scene, chosen.light);
  const Vec2 u = paths.sampler.pair(dimension_base + Int(dimension::kLight));
  const LightSample s = sample_light(scene, place, v.reflect_from, paths.ray.time, u, active);

  BsdfValue value{Vec(Real(T(0.25) * kInvPi)), Real(kPdfSphere)};
  value.f = value.f * v.material.base_color;  // isotropic phase function times albedo
  if (any(v.on_surface && s.valid)) {
    BsdfValue f = eval_bsdf(scene, v.material, frame, v.wo, s.d);
    const Mask above = dot(v.ng, s.d) > Real(0);
    value.f = select(v.in_medium, value.f, select(above, f.f, Vec(Real(0))));
    value.pdf = select(v.in_medium, value.pdf, f.pdf);
  }

  Ray shadow = paths.ray;
  shadow.o = v.reflect_from;
  shadow.d = s.d;
  const Vec emission = light_radiance(scene, place, s, shadow);

  const Real pdf = s.pdf * chosen.pmf;
  const Real weight = power_heuristic(pdf, value.pdf) / pdf;
  Vec light = paths.throughput * value.f * emission * weight;
  const Mask wanted = s.valid && max_component(light) > Real(0);
  if (none(wanted)) return;
  shadow.from = select(v.in_medium, Int(kNoHit), shadow.from);
  shadow.inside = false;
  shadow.skip = place.primitive;
  shadow.skip_slot = place.slot;
  shadow.skip_back = dot(s.n, s.d) >= Real(0);
  // Both ends are kept apart from their surfaces by identity and by the offset; the margin only
  // covers the rounding of the distance itself, for surfaces that touch the light.
  const Real t_max = s.distance * (T(1) - 16 * kEpsilon);
  NearestHit blocker = no_hit(t_max);
  find_hits<true>(scene, shadow, wanted, blocker);
  counters.shadow_rays += static_cast<std::uint64_t>(__builtin_popcount(bits(wanted)));
  const Mask visible = wanted && blocker.primitive == Int(kNoHit);
  if (scene.medium_count > 0 && any(visible))
    light = light * transmittance(scene, shadow, s.distance, visible);
  paths.radiance = select(visible, paths.radiance + light, paths.radiance);
}

/// Emission met by the paths' own rays, weighted against light sampling.
inline void add_emission(const SceneView<T>& scene, const Vertex& v, const NearestHit& hit,
                         Paths& paths) {
  const Mask bright = v.on_surface && (v.front || v.material.two_sided) &&
                      max_component(v.material.emission) > Real(0);
  if (none(bright)) return;
  Real weight(1);
  const Mask sampled = bright && paths.pdf > Real(0);
  if (any(sampled)) {
    const Int primitive = select(sampled, hit.primitive, Int(0U));
    const Int first_light = gather(scene.first_light, primitive);
    const Mask known = sampled && first_light != Int(kNoLight);
    const Mask mesh =
        gather(scene.kind, primitive) == Int(static_cast<std::uint32_t>(PrimitiveKind::Mesh));
    const Int light = select(known, first_light + select(mesh, hit.slot, Int(0U)), Int(0U));
    const Real pdf = gather(scene.light_pmf, light) *
                     pdf_light(scene, {primitive, hit.slot}, paths.ray.o, paths.ray.time,
                               paths.ray.d, hit.t, v.surface.ng, known);
    weight = select(known, power_heuristic(paths.pdf, pdf), weight);
  }
  paths.radiance = select(
      bright, madd(paths.throughput * v.material.emission, weight, paths.radiance), paths.radiance);
}

/// Advances every live path by one vertex.
inline void step(const SceneView<T>& scene, Paths& paths, Counters& counters) {
  const Mask alive = paths.alive;
  counters.rays += static_cast<std::uint64_t>(__builtin_popcount(bits(alive)));
  NearestHit hit = no_hit(Real(kInfinity));
  find_hits<false>(scene, paths.ray, alive, hit);
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
    paths.radiance = select(escaped, paths.radiance + paths.throughput * sky, paths.radiance);
  }
  Mask going = v.on_surface || v.in_medium;
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
  if (scene.has_emission && any(v.on_surface)) add_emission(scene, v, hit, paths);

  v.reflect_from = madd(v.ng, v.offset, v.surface.p);
  if (scene.medium_count > 0) {
    const Vec p = madd(paths.ray.d, medium.t, paths.ray.o);
    v.reflect_from = select(v.in_medium, p, v.reflect_from);
    v.material.base_color = select(v.in_medium, medium.albedo, v.material.base_color);
    v.n = select(v.in_medium, v.wo, v.n);
  }
  going = going && paths.segments < Int(static_cast<std::uint32_t>(scene.max_depth)) &&
          (v.in_medium || !is_kind(v.material, BsdfKind::Black));
  const Frame frame(v.n);
  // From here on the ray remembers the surface it leaves.
  paths.ray.from = select(v.in_medium, Int(kNoHit), hit.primitive);
  paths.ray.from_slot = hit.slot;
  const Mask lit = going && (v.in_medium || !is_delta_or_black(v.material));
  if (scene.light_count > 0 && any(lit))
    add_direct_light(scene, v, frame, dimension_base, lit, paths, counters);

  const Vec2 u = paths.sampler.pair(dimension_base + Int(dimension::kBsdf));
  const Real u_lobe = scene.has_dielectric || scene.has_fuzz
                          ? paths.sampler.pair(dimension_base + Int(dimension::kDistance)).x
                          : Real(0);
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
  paths.throughput = paths.throughput * next.weight;
  paths.pdf = select(next.delta, Real(0), next.pdf);
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
    const Real survival =
        min(max_component(paths.throughput) * paths.roulette_scale, Real(T(0.95)));
    const Real dice = paths.sampler.pair(dimension_base + Int(dimension::kChoice)).y;
    going = going && (!roulette || dice < survival);
    paths.throughput =
        select(roulette && going, paths.throughput * (Real(1) / survival), paths.throughput);
  }
  going = going && max_component(paths.throughput) > Real(0);
  const Vec through = madd(v.ng, -v.offset, v.surface.p);
  paths.ray.o = select(same_side || v.in_medium, v.reflect_from, through);
  paths.ray.d = next.wi;
  paths.ray.inside = !v.in_medium && dot(next.wi, v.surface.ng) < Real(0);
  paths.alive = going;
}

inline void render_work(const SceneView<T>& scene, const Work& work, FilmView film,
                        Counters& counters) {
  Jobs jobs(work, film.width);
  Paths paths = start_paths(scene, jobs, Mask(true));
  Mask used = paths.alive;
  while (any(used)) {
    step(scene, paths, counters);
    const Mask done = used && !paths.alive;
    if (none(done)) continue;
    splat(scene, paths, done, work, film, counters);
    if (jobs.next < jobs.count) {
      paths = select(done, start_paths(scene, jobs, done), paths);
    }
    used = paths.alive;
  }
}

LIGHTBENCH_KERNEL_END
