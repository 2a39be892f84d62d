#include "core/query/path.h"

#include <string>

#include "core/kernel/dispatch.h"
#include "core/query/convert.h"

namespace lightbench {
namespace {

template <class T>
int object_of(const GeometryPart<T>& geometry, std::uint32_t primitive) {
  return primitive == kNoHit ? kNone : geometry.object[primitive];
}

template <class T>
LightTry light_of(const GeometryPart<T>& geometry, const KernelPathVertex& k) {
  LightTry light;
  light.point.valid = k.light.valid;
  light.via = object_of(geometry, k.via);
  light.point.light = static_cast<int>(k.light.light);
  light.point.direction = vec(k.light.d);
  light.point.distance = k.light.distance / geometry.space.scale;
  light.point.normal = vec(k.light.n);
  light.point.pdf = k.light.pdf;
  light.point.selection = k.light.selection;
  light.point.radiance = vec(k.light.radiance);
  light.value = vec(k.light_value);
  light.value_pdf = k.light_value_pdf;
  light.weight = k.light_weight;
  light.visible = k.light_visible;
  light.blocker = object_of(geometry, k.blocker);
  light.added = vec(k.light_added);
  return light;
}

template <class T>
PathVertex from_kernel(const KernelParts<T>& parts, const KernelPathVertex& k) {
  const GeometryPart<T>& geometry = *parts.geometry;
  const RenderSpace& space = geometry.space;
  PathVertex v;
  v.origin = space.to_scene(vec(k.o));
  v.direction = vec(k.d);
  v.time = shutter_time(geometry, k.time);
  v.throughput = vec(k.throughput);
  v.radiance = vec(k.radiance);
  if (k.ends) v.end = k.end;
  if (k.emits) v.emission = {vec(k.emission), k.emission_weight};
  if (k.place == KernelPathVertex::Place::Nowhere) return v;
  v.in_medium = k.place == KernelPathVertex::Place::Medium;
  v.object = object_of(geometry, k.primitive);
  if (v.object != kNone) {
    if (const auto* mesh = mesh_part(parts, k.primitive)) {
      v.triangle = static_cast<int>(mesh->slot_triangle[k.slot]);
    }
  }
  v.distance = k.t / space.scale;
  v.position = space.to_scene(vec(k.p));
  v.geometric_normal = vec(k.ng);
  v.shading_normal = vec(k.n);
  v.front = k.front;
  v.base_color = vec(k.base_color);
  if (k.light_sampled) v.light = light_of(geometry, k);
  if (k.scattered) {
    v.scattered = {k.next.valid, k.next.delta, vec(k.next.wi), vec(k.next.weight), k.next.pdf};
  }
  v.survival = k.survival;
  return v;
}

}  // namespace

PathRecord trace_path(const RenderScene& scene, const SampleName& name) {
  if (name.x < 0 || name.x >= scene.width || name.y < 0 || name.y >= scene.height) {
    throw Error(ErrorKind::Usage, "pixel " + std::to_string(name.x) + "," + std::to_string(name.y) +
                                      ": expected one of the picture's " +
                                      std::to_string(scene.width) + "x" +
                                      std::to_string(scene.height));
  }
  return with_kernel(scene, [&](const auto& kernel, const auto& parts) {
    std::vector<KernelPathVertex> vertices;
    KernelPath path{};
    path.context = &vertices;
    path.add = [](void* context, const KernelPathVertex& v) {
      static_cast<std::vector<KernelPathVertex>*>(context)->push_back(v);
    };
    kernel.queries->trace_path(parts.view, name, path);
    PathRecord record;
    for (const KernelPathVertex& v : vertices) record.vertices.push_back(from_kernel(parts, v));
    record.radiance = record.vertices.back().radiance;
    record.film = path.film;
    if (path.counters.non_finite > 0) record.fault = path.counters.bad_fault;
    return record;
  });
}

}  // namespace lightbench
