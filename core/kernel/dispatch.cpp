// Kernel choice at start-up, and the public calls that go through it.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <variant>

#include "core/compile/parts.h"
#include "core/kernel/targets.h"

namespace lightbench {
namespace {

const KernelTable<float>& float_kernel(KernelKind kind) {
#ifdef LIGHTBENCH_X86
  if (kind == KernelKind::Avx512) return avx512::kernel;
  if (kind == KernelKind::Avx2) return avx2::kernel;
#endif
  (void)kind;
  return scalar::kernel;
}

/// Calls f(kernel table, view) with the number type the scene was compiled for.
template <class F>
auto with_kernel(const RenderScene& scene, F f) {
  if (const auto* p = std::get_if<KernelParts<double>>(&scene.parts->kernel)) {
    return f(reference::kernel, p->view, *p->geometry);
  }
  const auto& p = std::get<KernelParts<float>>(scene.parts->kernel);
  return f(float_kernel(scene.kernel), p.view, *p.geometry);
}

/// The ray in render space; `unit` is the length of its direction there.
template <class T>
KernelRay to_kernel(const GeometryPart<T>& geometry, const Ray& ray, double& unit) {
  const glm::dvec3 o = geometry.space.to_render(ray.origin);
  const glm::dvec3 d = ray.direction * geometry.space.scale;
  unit = glm::length(d);
  KernelRay k{};
  for (int i = 0; i < 3; ++i) {
    k.o[i] = o[i];
    k.d[i] = d[i] / unit;
  }
  const double shutter = geometry.shutter_close - geometry.shutter_open;
  k.time = shutter > 0 ? (ray.time - geometry.shutter_open) / shutter : 0;
  k.t_max = std::min(ray.t_max * unit, 1e30);
  return k;
}

glm::dvec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

const char* kernel_name(KernelKind kind) {
  switch (kind) {
    case KernelKind::Auto:
      return "auto";
    case KernelKind::Avx512:
      return "avx512";
    case KernelKind::Avx2:
      return "avx2";
    case KernelKind::Scalar:
      return "scalar";
    case KernelKind::Reference:
      return "reference";
  }
  return "";
}

bool kernel_supported(KernelKind kind) {
#ifdef LIGHTBENCH_X86
  // The levels x86-64-v3 and v4 by the features that tell their processors apart: clang 14, which
  // lints this file, does not know the levels' names.
  const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                  __builtin_cpu_supports("bmi2") != 0;
  if (kind == KernelKind::Avx2) return v3;
  if (kind == KernelKind::Avx512) {
    return v3 && __builtin_cpu_supports("avx512f") != 0 &&
           __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
           __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  }
#else
  if (kind == KernelKind::Avx512 || kind == KernelKind::Avx2) return false;
#endif
  return true;
}

KernelKind best_kernel() {
  for (const KernelKind kind : {KernelKind::Avx512, KernelKind::Avx2}) {
    if (kernel_supported(kind)) return kind;
  }
  return KernelKind::Scalar;
}

Counters& Counters::operator+=(const Counters& other) {
  if (non_finite == 0 && other.non_finite > 0) {
    bad_x = other.bad_x;
    bad_y = other.bad_y;
    bad_sample = other.bad_sample;
  }
  paths += other.paths;
  rays += other.rays;
  shadow_rays += other.shadow_rays;
  non_finite += other.non_finite;
  return *this;
}

void render(const RenderScene& scene, const Work& work, FilmView film, Counters& counters) {
  with_kernel(scene, [&](const auto& kernel, const auto& view, const auto&) {
    kernel.render(view, work, film, counters);
  });
}

std::optional<Hit> trace(const RenderScene& scene, const Ray& ray) {
  return with_kernel(
      scene, [&](const auto& kernel, const auto& view, const auto& geometry) -> std::optional<Hit> {
        double unit = 1;
        const KernelHit k = kernel.trace(view, to_kernel(geometry, ray, unit));
        if (!k.found) return std::nullopt;
        Hit hit;
        hit.object = geometry.object[k.primitive];
        hit.t = k.t / unit;
        hit.position = geometry.space.to_scene(vec(k.p));
        hit.geometric_normal = vec(k.ng);
        hit.shading_normal = vec(k.ns);
        hit.tangent = vec(k.tangent);
        hit.u = k.u;
        hit.v = k.v;
        hit.front = k.front;
        return hit;
      });
}

bool occluded(const RenderScene& scene, const Ray& ray) {
  return with_kernel(scene, [&](const auto& kernel, const auto& view, const auto& geometry) {
    double unit = 1;
    return kernel.occluded(view, to_kernel(geometry, ray, unit));
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
