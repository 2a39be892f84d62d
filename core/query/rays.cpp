#include "core/query/rays.h"

#include <cmath>

#include "core/kernel/dispatch.h"
#include "core/query/convert.h"

namespace lightbench {
namespace {

/// Farthest distance in render space, well within float.
constexpr double kFarthest = 1e30;

/// Length in render space of the ray's unit of distance.
template <class T>
double unit_of(const GeometryPart<T>& geometry, const Ray& ray) {
  return safe_length(ray.direction) * geometry.space.scale;
}

template <class T>
KernelRay to_kernel(const KernelParts<T>& parts, const Ray& ray) {
  const GeometryPart<T>& geometry = *parts.geometry;
  KernelRay k{};
  const glm::dvec3 d = ray.direction / safe_length(ray.direction);
  glm::dvec3 o = to_render(geometry.space, ray.origin, ray.origin_remainder);
  const double unit = unit_of(geometry, ray);
  if (ray.t_min != 0) o += d * (ray.t_min * unit);
  put(o, k.o);
  put(d, k.d);
  k.time = shutter_share(geometry, ray.time);
  k.t_max = std::min((ray.t_max - ray.t_min) * unit, kFarthest);
  k.from = ray.from.object == kNone
               ? kNoHit
               : geometry.surface_of_object[static_cast<std::size_t>(ray.from.object)];
  k.from_slot = kNoHit;
  k.inside = ray.from.inside;
  if (k.from != kNoHit && ray.from.triangle != kNone) {
    if (const auto* mesh = mesh_part(parts, k.from)) {
      k.from_slot = mesh->triangle_slot[static_cast<std::size_t>(ray.from.triangle)];
    }
  }
  return k;
}

template <class T>
Hit from_kernel(const KernelParts<T>& parts, const Ray& ray, const KernelHit& k) {
  const GeometryPart<T>& geometry = *parts.geometry;
  Hit hit;
  hit.object = geometry.object[k.primitive];
  hit.t = ray.t_min + k.t / unit_of(geometry, ray);
  to_scene(geometry.space, vec(k.p), hit.position, hit.position_remainder);
  hit.geometric_normal = vec(k.ng);
  hit.shading_normal = vec(k.ns);
  hit.tangent = vec(k.tangent);
  hit.u = k.u;
  hit.v = k.v;
  hit.front = k.front;
  if (const auto* mesh = mesh_part(parts, k.primitive)) {
    hit.triangle = static_cast<int>(mesh->slot_triangle[k.slot]);
  }
  return hit;
}

}  // namespace

void trace(const RenderScene& scene, std::span<const Ray> rays,
           std::span<std::optional<Hit>> hits) {
  check_lengths(rays.size(), hits.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    ask_in_parts<KernelRay, KernelHit>(
        rays, [&](const Ray& ray) { return to_kernel(parts, ray); },
        [&](auto in, auto out) { kernel.queries->trace(parts.view, in, out); },
        [&](std::size_t i, const KernelHit& k) {
          hits[i] = k.found ? std::optional(from_kernel(parts, rays[i], k)) : std::nullopt;
        });
  });
}

std::optional<Hit> trace(const RenderScene& scene, const Ray& ray) {
  std::optional<Hit> hit;
  trace(scene, {&ray, 1}, {&hit, 1});
  return hit;
}

void occluded(const RenderScene& scene, std::span<const Ray> rays,
              std::span<std::uint8_t> blocked) {
  check_lengths(rays.size(), blocked.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    ask_in_parts<KernelRay, std::uint8_t>(
        rays, [&](const Ray& ray) { return to_kernel(parts, ray); },
        [&](auto in, auto out) {
          kernel.queries->occluded(with_all_occluders(parts.view), in, out);
        },
        [&](std::size_t i, std::uint8_t answer) { blocked[i] = answer; });
  });
}

bool occluded(const RenderScene& scene, const Ray& ray) {
  std::uint8_t blocked = 0;
  occluded(scene, {&ray, 1}, {&blocked, 1});
  return blocked != 0;
}

Ray spawn(const RenderScene& scene, const Hit& hit, const glm::dvec3& direction, double time) {
  return with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    const auto& geometry = *parts.geometry;
    KernelExit exit{};
    put(to_render(geometry.space, hit.position, hit.position_remainder), exit.p);
    put(hit.geometric_normal, exit.ng);
    exit.primitive = geometry.surface_of_object[static_cast<std::size_t>(hit.object)];
    exit.inside = glm::dot(direction, hit.geometric_normal) < 0;
    KernelPoint origin{};
    kernel.queries->leave(parts.view, {&exit, 1}, {&origin, 1});
    Ray ray;
    to_scene(geometry.space, vec(origin.p), ray.origin, ray.origin_remainder);
    ray.direction = direction;
    ray.time = time;
    ray.from = {hit.object, hit.triangle, exit.inside};
    return ray;
  });
}

Ray as_traced(const RenderScene& scene, const Ray& ray) {
  return with_kernel(scene, [&]<class T>(const KernelTable<T>&, const KernelParts<T>& parts) {
    const auto rounded = [](double x) { return static_cast<double>(static_cast<T>(x)); };
    const GeometryPart<T>& geometry = *parts.geometry;
    const KernelRay k = to_kernel(parts, ray);
    Ray seen = ray;
    glm::dvec3 o;
    for (int a = 0; a < 3; ++a) {
      o[a] = rounded(k.o[a]);
      seen.direction[a] = rounded(k.d[a]);
    }
    to_scene(geometry.space, o, seen.origin, seen.origin_remainder);
    seen.t_min = 0;
    seen.t_max = rounded(k.t_max) / geometry.space.scale;
    seen.time = shutter_time(geometry, rounded(k.time));
    return seen;
  });
}

Ray camera_ray(const Scene& scene, double x, double y) {
  const Camera& c = scene.camera;
  const glm::dvec3 forward = glm::normalize(c.look_at - c.look_from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, c.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double half_height = std::tan(c.vfov * 0.008726646259971648);  // half of it, in radians
  const double half_width = half_height * scene.render.width / scene.render.height;
  Ray ray;
  ray.origin = c.look_from;
  ray.direction = glm::normalize(forward + right * (half_width * (2 * x / scene.render.width - 1)) +
                                 up * (half_height * (1 - 2 * y / scene.render.height)));
  ray.time = 0.5 * (c.shutter_open + c.shutter_close);
  return ray;
}

}  // namespace lightbench
