#include "core/query/lights.h"

#include "core/kernel/dispatch.h"
#include "core/query/convert.h"

namespace lightbench {
namespace {

std::uint32_t kernel_light(int light) {
  return light == kNone ? kNoLight : static_cast<std::uint32_t>(light);
}

/// Random bits that a number in [0,1) stands for.
std::uint32_t bits_of(double unit) { return static_cast<std::uint32_t>(unit * 0x1p32); }

template <class T>
LightPoint from_kernel(const GeometryPart<T>& geometry, const KernelLightPoint& k) {
  LightPoint p;
  p.valid = k.valid;
  if (!k.valid) return p;
  p.light = static_cast<int>(k.light);
  p.direction = vec(k.d);
  p.distance = k.distance / geometry.space.scale;
  p.normal = vec(k.n);
  p.pdf = k.pdf;
  p.selection = k.selection;
  p.radiance = vec(k.radiance);
  return p;
}

}  // namespace

int light_count(const RenderScene& scene) {
  return with_kernel(scene, [](const auto&, const auto& parts) {
    return static_cast<int>(parts.lights->primitive.size());
  });
}

LightSource light_source(const RenderScene& scene, int light) {
  return with_kernel(scene, [&](const auto&, const auto& parts) {
    const auto i = static_cast<std::size_t>(light);
    const std::uint32_t primitive = parts.lights->primitive.at(i);
    LightSource source;
    source.object = parts.geometry->object[primitive];
    source.selection = static_cast<double>(parts.lights->pmf[i]);
    if (const auto* mesh = mesh_part(parts, primitive)) {
      const std::uint32_t triangle = mesh->slot_triangle[parts.lights->slot[i]];
      if (triangle != Bvh::kPadding) source.triangle = static_cast<int>(triangle);
    }
    return source;
  });
}

void sample_lights(const RenderScene& scene, std::span<const LightQuery> queries,
                   std::span<LightPoint> points) {
  check_lengths(queries.size(), points.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    const auto& geometry = *parts.geometry;
    if (parts.view.light_count == 0) throw Error(ErrorKind::Scene, "the scene has no lights");
    ask_in_parts<KernelLightQuery, KernelLightPoint>(
        queries,
        [&](const LightQuery& q) {
          KernelLightQuery k{};
          put(geometry.space.to_render(q.point), k.p);
          put(q.normal, k.n);
          k.u[0] = q.u;
          k.u[1] = q.v;
          k.time = shutter_share(geometry, q.time);
          k.choice = bits_of(q.choice);
          k.light = kernel_light(q.light);
          return k;
        },
        [&](auto in, auto out) { kernel.queries->sample_lights(parts.view, in, out); },
        [&](std::size_t i, const KernelLightPoint& k) { points[i] = from_kernel(geometry, k); });
  });
}

void pdf_lights(const RenderScene& scene, std::span<const LightDirection> queries,
                std::span<LightPoint> points) {
  check_lengths(queries.size(), points.size());
  with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    const auto& geometry = *parts.geometry;
    if (parts.view.light_count == 0) {
      std::fill(points.begin(), points.end(), LightPoint{});
      return;
    }
    ask_in_parts<KernelLightDirection, KernelLightPoint>(
        queries,
        [&](const LightDirection& q) {
          KernelLightDirection k{};
          put(geometry.space.to_render(q.point), k.p);
          put(q.normal, k.n);
          put(q.direction / safe_length(q.direction), k.d);
          k.time = shutter_share(geometry, q.time);
          k.light = kernel_light(q.light);
          return k;
        },
        [&](auto in, auto out) { kernel.queries->pdf_lights(parts.view, in, out); },
        [&](std::size_t i, const KernelLightPoint& k) { points[i] = from_kernel(geometry, k); });
  });
}

}  // namespace lightbench
