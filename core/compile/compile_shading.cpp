#include "core/compile/compile_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/compile/columns.h"
#include "core/compile/light_candidates.h"
#include "core/compile/light_tree.h"

namespace lightbench {
namespace {

ImageView view_of(const Texels* image) {
  if (image == nullptr) return {};
  if (image->packed.empty())
    return {image->rgb.data(), nullptr, nullptr, image->width, image->height};
  return {nullptr, image->packed.data(), image->values.data(), image->width, image->height};
}

BsdfKind bsdf_of(const Material& m) {
  switch (m.kind) {
    case MaterialKind::Lambertian:
      return BsdfKind::Lambertian;
    case MaterialKind::Dielectric:
      return BsdfKind::Dielectric;
    case MaterialKind::Emissive:
      return BsdfKind::Black;
    case MaterialKind::Metal:
      break;
  }
  if (m.fuzz > 0) return BsdfKind::Fuzz;
  return m.roughness > 0 ? BsdfKind::Ggx : BsdfKind::Mirror;
}

glm::dvec3 emission(const Material& m) { return m.emissive * m.emissive_strength; }

}  // namespace

template <class T>
std::shared_ptr<const MaterialPart<T>> compile_materials(const Scene& scene,
                                                         const GeometryPart<T>& geometry) {
  auto part = std::make_shared<MaterialPart<T>>();
  for (const Material& m : scene.materials) {
    const glm::dvec3 e = emission(m);
    const double row[kMaterialStride] = {static_cast<double>(bsdf_of(m)),
                                         m.base_color.x,
                                         m.base_color.y,
                                         m.base_color.z,
                                         static_cast<double>(m.base_color_texture),
                                         m.fuzz,
                                         m.roughness * m.roughness,
                                         m.ior,
                                         e.x,
                                         e.y,
                                         e.z,
                                         static_cast<double>(m.emissive_texture),
                                         m.two_sided ? 1.0 : 0.0};
    for (const double x : row) part->rows.push_back(static_cast<T>(x));
  }
  // Lanes that scatter in a medium read row 0 too; a scene of media alone has no material.
  if (part->rows.empty()) part->rows.resize(kMaterialStride);
  append_columns(part->rows.data(), part->rows.size() / kMaterialStride, kMaterialStride,
                 part->columns);
  for (std::size_t i = 0; i < geometry.object.size(); ++i) {
    const Object& o = scene.objects[static_cast<std::size_t>(geometry.object[i])];
    part->of_primitive.push_back(i < geometry.surface_count ? static_cast<std::uint32_t>(o.material)
                                                            : 0U);
    if (i < geometry.surface_count) {
      const glm::dvec3 e = emission(scene.materials[static_cast<std::size_t>(o.material)]);
      part->brightest = std::max({part->brightest, e.x, e.y, e.z});
      continue;
    }
    const Medium& m = scene.media[static_cast<std::size_t>(o.medium)];
    MediumView<T> view{};
    view.boundary = static_cast<std::uint32_t>(i);
    view.sigma = static_cast<T>(m.density / geometry.space.scale);
    for (int k = 0; k < 3; ++k) view.albedo[k] = static_cast<T>(m.albedo[k]);
    part->media.push_back(view);
  }
  append_columns(part->of_primitive.data(), part->of_primitive.size(), 1,
                 part->of_primitive_column);
  return part;
}

template <class T>
std::shared_ptr<const TexturePart<T>> compile_textures(const Scene& scene) {
  auto part = std::make_shared<TexturePart<T>>();
  for (const Texture& t : scene.textures) {
    const double row[kTextureStride] = {static_cast<double>(t.kind),
                                        t.color_a.x,
                                        t.color_a.y,
                                        t.color_a.z,
                                        t.color_b.x,
                                        t.color_b.y,
                                        t.color_b.z,
                                        t.scale,
                                        t.use_uv ? 1.0 : 0.0,
                                        static_cast<double>(t.octaves),
                                        static_cast<double>(t.seed & 0xffffffU),
                                        static_cast<double>(t.wrap)};
    for (const double x : row) part->rows.push_back(static_cast<T>(x));
    part->keep.push_back(t.image);
    part->images.push_back(view_of(t.image.get()));
  }
  return part;
}

template <class T>
std::shared_ptr<const LightPart<T>> compile_lights(const Scene& scene,
                                                   const GeometryPart<T>& geometry) {
  auto part = std::make_shared<LightPart<T>>();
  std::vector<double> power;
  const auto add = [&](std::uint32_t primitive, std::uint32_t slot, double value) {
    part->primitive.push_back(primitive);
    part->slot.push_back(slot);
    power.push_back(value);
  };
  for (std::uint32_t i = 0; i < geometry.surface_count; ++i) {
    const Object& o = scene.objects[static_cast<std::size_t>(geometry.object[i])];
    const Material& m = scene.materials[static_cast<std::size_t>(o.material)];
    part->first_of_primitive.push_back(kNoLight);
    if (!emits(m)) continue;
    const glm::dvec3 e = emission(m);
    const double radiance = luminance(e) * (m.two_sided ? 2 : 1);
    part->first_of_primitive.back() = static_cast<std::uint32_t>(part->primitive.size());
    if (geometry.kind[i] != static_cast<std::uint32_t>(PrimitiveKind::Mesh)) {
      add(i, 0, radiance * geometry.area[i]);
      continue;
    }
    // One light per slot of the mesh, padding included (with no power), so that slot numbers index
    // them.
    const auto& mesh =
        *geometry.meshes[static_cast<std::size_t>(std::get<MeshShape>(o.shape).mesh)];
    const T* map = &geometry.rows[geometry.row[i] + 12];
    for (std::uint32_t s = 0; s < mesh.slot_triangle.size(); ++s) {
      const auto& block = mesh.blocks[s / kBvhWidth];
      const auto vertex = [&](std::size_t v) {
        glm::dvec3 p;
        for (int k = 0; k < 3; ++k) {
          const auto at = 4 * static_cast<std::size_t>(k);
          p[k] = 0;
          for (std::size_t j = 0; j < 3; ++j) {
            p[k] += static_cast<double>(map[at + j]) *
                    static_cast<double>(block.v[3 * v + j][s % kBvhWidth]);
          }
        }
        return p;
      };
      const double area =
          0.5 * glm::length(glm::cross(vertex(1) - vertex(0), vertex(2) - vertex(0)));
      add(i, s, mesh.slot_triangle[s] == Bvh::kPadding ? 0 : radiance * area);
    }
  }
  for (std::size_t i = geometry.surface_count; i < geometry.object.size(); ++i) {
    part->first_of_primitive.push_back(kNoLight);
  }
  append_columns(part->first_of_primitive.data(), part->first_of_primitive.size(), 1,
                 part->first_of_primitive_column);
  append_columns(part->primitive.data(), part->primitive.size(), 1, part->primitive_column);
  // Vose's alias method.
  const std::size_t n = power.size();
  double total = 0;
  for (const double p : power) total += p;
  part->pmf.resize(n);
  part->alias_threshold.assign(n, T(1));
  part->alias_other.resize(n);
  std::vector<double> share(n);
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < n; ++i) {
    part->pmf[i] = static_cast<T>(power[i] / total);
    part->alias_other[i] = i;
    share[i] = power[i] / total * static_cast<double>(n);
    (share[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    part->alias_threshold[s] = static_cast<T>(share[s]);
    part->alias_other[s] = l;
    share[l] -= 1 - share[s];
    if (share[l] < 1) {
      large.pop_back();
      small.push_back(l);
    }
  }
  const std::vector<Lamp> lamps = find_lamps(scene, geometry, *part);
  if (lamps.size() > kMaxLightCandidates) {
    add_light_tree(lamps, *part);
  } else {
    add_light_candidates(scene, geometry, lamps, *part);
  }
  return part;
}

template <class T>
CameraView<T> compile_camera(const Scene& scene, const GeometryPart<T>& geometry,
                             const Crop& crop) {
  const Camera& c = scene.camera;
  const RenderSettings& r = scene.render;
  const glm::dvec3 forward = glm::normalize(c.look_at - c.look_from);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, c.up));
  const glm::dvec3 up = glm::cross(right, forward);
  const double half_height = std::tan(0.5 * glm::radians(c.vfov));
  const double half_width = half_height * r.width / r.height;
  const glm::dvec3 origin = geometry.space.to_render(c.look_from);
  CameraView<T> v{};
  for (int k = 0; k < 3; ++k) {
    v.origin[k] = static_cast<T>(origin[k]);
    v.right[k] = static_cast<T>(right[k] * half_width);
    v.up[k] = static_cast<T>(up[k] * half_height);
    v.forward[k] = static_cast<T>(forward[k]);
  }
  v.lens_radius = static_cast<T>(c.lens_radius * geometry.space.scale);
  v.focus_distance = static_cast<T>(c.focus_distance * geometry.space.scale);
  v.moving = geometry.moving;
  v.filter_radius = static_cast<T>(r.filter_radius);
  v.filter = static_cast<std::uint32_t>(r.filter);
  v.width = r.width;
  v.height = r.height;
  v.crop_x = crop.x;
  v.crop_y = crop.y;
  return v;
}

template <class T>
EnvironmentView<T> compile_environment(const Environment& e) {
  EnvironmentView<T> v{};
  v.kind = static_cast<std::uint32_t>(e.kind);
  if (e.kind == EnvironmentKind::Image && e.image == nullptr) v.kind = 0;
  for (int k = 0; k < 3; ++k) {
    v.color[k] = static_cast<T>(e.color[k] * e.strength);
    v.horizon[k] = static_cast<T>(e.horizon[k] * e.strength);
  }
  v.cos_rotation = static_cast<T>(std::cos(glm::radians(e.rotation)));
  v.sin_rotation = static_cast<T>(std::sin(glm::radians(e.rotation)));
  v.image = view_of(e.image.get());
  return v;
}

#define LIGHTBENCH_INSTANTIATE(T)                                                            \
  template std::shared_ptr<const MaterialPart<T>> compile_materials(const Scene&,            \
                                                                    const GeometryPart<T>&); \
  template std::shared_ptr<const TexturePart<T>> compile_textures<T>(const Scene&);          \
  template std::shared_ptr<const LightPart<T>> compile_lights(const Scene&,                  \
                                                              const GeometryPart<T>&);       \
  template CameraView<T> compile_camera(const Scene&, const GeometryPart<T>&, const Crop&);  \
  template EnvironmentView<T> compile_environment<T>(const Environment&);
LIGHTBENCH_INSTANTIATE(float)
LIGHTBENCH_INSTANTIATE(double)
#undef LIGHTBENCH_INSTANTIATE

}  // namespace lightbench
