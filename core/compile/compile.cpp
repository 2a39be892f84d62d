#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/compile/compile_geometry.h"
#include "core/compile/compile_mesh.h"
#include "core/compile/compile_shading.h"
#include "core/compile/feature_list.h"
#include "core/compile/parts.h"
#include "core/compile/scene_reach.h"
#include "core/kernel/targets.h"

namespace lightbench {
namespace {

constexpr Change kGeometryChanges = Change::Transforms | Change::Geometry | Change::Meshes;

/// True if what was measured before still describes the scene after `change`.
bool reach_stands(const SceneReach& reach, const Scene& scene, Change change) {
  return !any(change & kGeometryChanges) && reach.shutter_open == scene.camera.shutter_open &&
         reach.shutter_close == scene.camera.shutter_close && reach.roles == object_roles(scene);
}

glm::dvec3 channel_peaks(const Texels& image) {
  glm::dvec3 peak(0);
  for (std::size_t i = 0; i < image.count(); ++i) {
    const std::array<float, 3> color = image.color(i);
    peak = glm::max(peak, glm::dvec3(color[0], color[1], color[2]));
  }
  return peak;
}

/// Largest component of the environment's radiance.
double brightest(const Environment& e, const glm::dvec3& image_peak) {
  const bool image = e.kind == EnvironmentKind::Image && e.image != nullptr;
  double m = 0;
  for (int k = 0; k < 3; ++k) {
    m = std::max(m, e.color[k] * e.strength * (image ? image_peak[k] : 1));
    if (e.kind == EnvironmentKind::Gradient) m = std::max(m, e.horizon[k] * e.strength);
  }
  return m;
}

bool used_by_surface(const Scene& scene, const std::vector<std::uint8_t>& roles, auto predicate) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if ((roles[i] & 1) == 0) continue;
    if (predicate(scene.materials[static_cast<std::size_t>(scene.objects[i].material)]))
      return true;
  }
  return false;
}

/// Points the view at the parts and sets the flags of what the scene uses.
template <class T>
void fill_view(const Scene& scene, const Crop& crop, double film_unit, KernelParts<T>& p) {
  SceneView<T>& v = p.view;
  const GeometryPart<T>& g = *p.geometry;
  v = {};
  v.surface_count = g.surface_count;
  v.kind = g.kind.data();
  const auto surfaces_end = g.kind.begin() + g.surface_count;
  for (unsigned k = 0; k <= kPrimitiveKinds; ++k) {
    v.kind_begin[k] = static_cast<std::uint32_t>(std::lower_bound(g.kind.begin(), surfaces_end, k) -
                                                 g.kind.begin());
  }
  for (unsigned k = 0; k < kPrimitiveKinds; ++k)
    v.occluders_end[k] = v.kind_begin[k + 1] - g.walls[k];
  const auto of_kind = [&v](PrimitiveKind kind) {
    const auto k = static_cast<unsigned>(kind);
    return v.kind_begin[k + 1] - v.kind_begin[k];
  };
  v.has_triangles = of_kind(PrimitiveKind::Triangle) + of_kind(PrimitiveKind::Mesh) > 0;
  v.row = g.row.data();
  v.rows = g.rows.data();
  const auto or_null = [](const auto& columns) {
    return columns.empty() ? nullptr : columns.data();
  };
  for (unsigned k = 0; k < kPrimitiveKinds; ++k) v.columns[k] = or_null(g.columns[k]);
  v.offset = {g.offset.data(), or_null(g.offset_column)};
  v.meshes = g.mesh_views.data();
  v.hit_quality =
      range_of(*g.reach, scene.camera) <= kPlainRange ? HitQuality::Plain : HitQuality::Refined;
  v.boxes = or_null(g.boxes);
  if (!g.tree.nodes.empty()) {
    v.nodes = g.tree.nodes.data();
    v.motion = g.tree.motion.empty() ? nullptr : g.tree.motion.data();
    v.leaves = g.tree.items.data();
    v.wide_count = static_cast<std::uint32_t>(g.wide.size());
    v.wide = g.wide.data();
    v.beyond_cache = g.tree.nodes.size() * sizeof(BvhNode) > kCacheBytes;
  }
  v.material = {p.materials->of_primitive.data(), or_null(p.materials->of_primitive_column)};
  v.materials = p.materials->rows.data();
  v.material_columns = or_null(p.materials->columns);
  v.medium_count = static_cast<std::uint32_t>(p.materials->media.size());
  v.media = p.materials->media.data();
  v.textures = p.textures->rows.data();
  v.images = p.textures->images.data();
  v.first_light = {p.lights->first_of_primitive.data(),
                   or_null(p.lights->first_of_primitive_column)};
  v.light_count = static_cast<std::uint32_t>(p.lights->primitive.size());
  v.light_primitive = {p.lights->primitive.data(), or_null(p.lights->primitive_column)};
  v.light_slot = p.lights->slot.data();
  v.light_pmf = p.lights->pmf.data();
  v.alias_threshold = p.lights->alias_threshold.data();
  v.alias_other = p.lights->alias_other.data();
  const LightChoiceBy choice = scene.render.light_choice;
  if (choice != LightChoiceBy::Power) {
    v.direct_candidates = p.lights->direct_candidates;
    v.candidate_count = v.direct_candidates;
    v.light_candidates = p.lights->candidates.data();
    if (!p.lights->tree_child.empty()) {
      v.light_cluster_bits = p.lights->tree_cluster_bits;
      v.light_clusters = 1U << v.light_cluster_bits;
      v.light_nodes = p.lights->tree_rows.data();
      v.light_children = p.lights->tree_child.data();
      v.light_trail = p.lights->tree_trail.data();
    }
  }
  if (choice == LightChoiceBy::Images) {
    v.candidate_count =
        static_cast<std::uint32_t>(p.lights->candidates.size() / kLightCandidateStride);
    v.mirror_count = p.lights->mirror_count;
    v.face_count = static_cast<std::uint32_t>(p.lights->face_end.size());
    v.faces = p.lights->faces.data();
    v.face_columns = or_null(p.lights->face_columns);
    v.face_end = p.lights->face_end.data();
    v.image_candidate = p.lights->image_candidate.data();
    v.lens_count = static_cast<std::uint32_t>(p.lights->lens_end.size());
    v.lenses = p.lights->lenses.data();
    v.lens_tables = p.lights->lens_tables.data();
    v.first_lens_candidate = p.lights->first_lens_candidate;
    v.lens_end = p.lights->lens_end.data();
  }
  v.independent_samples = scene.render.sampler == SamplerKind::Independent;
  v.camera = compile_camera(scene, g, crop);
  v.environment = compile_environment<T>(scene.environment);
  v.max_depth = scene.render.max_depth;
  v.roulette_depth = scene.render.roulette_depth;
  v.samples_lights = v.light_count > 0 && scene.render.strategy != Strategy::Bsdf;
  v.counts_hits_of_lights = scene.render.strategy != Strategy::Lights;
  v.seed = scene.render.seed;
  v.inverse_film_unit = static_cast<T>(1 / film_unit);

  const auto uses = [&](auto predicate) {
    return used_by_surface(scene, g.reach->roles, predicate);
  };
  const auto metal = [](const Material& m) { return m.kind == MaterialKind::Metal; };
  v.has_lambertian = uses([](const Material& m) { return m.kind == MaterialKind::Lambertian; });
  v.has_dielectric = uses([](const Material& m) { return m.kind == MaterialKind::Dielectric; });
  v.has_fuzz = uses([&](const Material& m) { return metal(m) && m.fuzz > 0; });
  v.has_ggx = uses([&](const Material& m) { return metal(m) && m.fuzz <= 0 && m.roughness > 0; });
  v.has_mirror =
      uses([&](const Material& m) { return metal(m) && m.fuzz <= 0 && m.roughness <= 0; });
  v.has_emission = uses([](const Material& m) { return emits(m); });
  v.has_textures = uses([](const Material& m) { return m.base_color_texture != kNone; });
  v.has_emission_textures =
      uses([](const Material& m) { return emits(m) && m.emissive_texture != kNone; });
  const auto textured_by = [&](auto predicate) {
    return uses([&](const Material& m) {
      const auto test = [&](int t) {
        return t != kNone && predicate(scene.textures[static_cast<std::size_t>(t)]);
      };
      return test(m.base_color_texture) || (emits(m) && test(m.emissive_texture));
    });
  };
  v.needs_uv = textured_by([](const Texture& t) {
    return t.kind == TextureKind::Image || (t.kind == TextureKind::Checker && t.use_uv);
  });
  const bool solid = textured_by([](const Texture& t) {
    return t.kind != TextureKind::Image && t.kind != TextureKind::Constant &&
           !(t.kind == TextureKind::Checker && t.use_uv);
  });
  v.to_object = solid ? g.to_object.data() : nullptr;
  v.has_environment = brightest(scene.environment, p.environment_peak) > 0;
}

template <class T>
std::int64_t bytes_of(const std::vector<T>& v) {
  return static_cast<std::int64_t>(v.size() * sizeof(T));
}

template <class T>
void fill_stats(const Scene& scene, const KernelParts<T>& p, RenderStats& s) {
  const GeometryPart<T>& g = *p.geometry;
  s.objects = static_cast<std::int64_t>(
      std::count_if(g.reach->roles.begin(), g.reach->roles.end(), [](auto r) { return r != 0; }));
  for (std::uint32_t i = 0; i < g.kind.size(); ++i) {
    const auto* m =
        std::get_if<MeshShape>(&scene.objects[static_cast<std::size_t>(g.object[i])].shape);
    s.primitives +=
        m == nullptr ? 1
                     : static_cast<std::int64_t>(
                           scene.meshes[static_cast<std::size_t>(m->mesh)].data->triangles.size());
  }
  for (const auto& m : g.meshes) {
    if (m == nullptr) continue;
    s.triangles += static_cast<std::int64_t>(m->source->triangles.size());
    s.bytes += bytes_of(*m);
  }
  s.lights =
      std::count_if(p.lights->pmf.begin(), p.lights->pmf.end(), [](T x) { return x > T(0); });
  s.bytes += bytes_of(g.kind) + bytes_of(g.row) + bytes_of(g.rows) + bytes_of(g.offset) +
             bytes_of(g.to_object) + bytes_of(g.object) + bytes_of(g.surface_of_object) +
             bytes_of(g.area) + bytes_of(g.tree.nodes) + bytes_of(g.tree.motion) +
             bytes_of(g.tree.items) + bytes_of(p.materials->rows) + bytes_of(p.lights->pmf) * 4 +
             bytes_of(p.textures->rows);
  for (const auto& image : p.textures->keep) {
    if (image != nullptr) s.bytes += bytes_of(image->rgb);
  }
  if (p.environment != nullptr) s.bytes += bytes_of(p.environment->rgb);
  s.features = feature_list(p.view);
}

template <class T>
std::shared_ptr<const RenderScene> compile_for(const Scene& scene, KernelKind kernel,
                                               std::shared_ptr<const SceneReach> reach,
                                               const RenderScene* previous, Change change) {
  const auto start = std::chrono::steady_clock::now();
  auto result = std::make_shared<RenderScene>();
  auto parts = std::make_shared<RenderScene::Parts>();
  KernelParts<T> p;
  const KernelParts<T>* old = nullptr;
  if (previous != nullptr && previous->parts != nullptr)
    old = std::get_if<KernelParts<T>>(&previous->parts->kernel);
  if (old == nullptr) change = Change::All;

  Change& rebuilt = result->stats.rebuilt;
  const bool keep_geometry = old != nullptr && old->geometry->reach == reach;
  if (keep_geometry) {
    p.geometry = old->geometry;
  } else {
    p.geometry = compile_geometry<T>(scene, reach, old != nullptr ? old->geometry.get() : nullptr);
    rebuilt |= Change::Geometry;
  }
  if (keep_geometry && !any(change & Change::Materials)) {
    p.materials = old->materials;
    p.lights = old->lights;
  } else {
    p.materials = compile_materials(scene, *p.geometry);
    p.lights = compile_lights(scene, *p.geometry);
    rebuilt |= Change::Materials;
  }
  if (old != nullptr && !any(change & Change::Textures)) {
    p.textures = old->textures;
  } else {
    p.textures = compile_textures<T>(scene);
    rebuilt |= Change::Textures;
  }
  p.environment = scene.environment.image;
  if (p.environment != nullptr) {
    const bool same = old != nullptr && old->environment == p.environment;
    p.environment_peak = same ? old->environment_peak : channel_peaks(*p.environment);
  }
  const double peak =
      std::max(p.materials->brightest, brightest(scene.environment, p.environment_peak));
  const bool shines = peak > 0 && std::isfinite(peak);
  result->film_unit = shines ? std::ldexp(1.0, std::ilogb(peak) + 1) : 1.0;
  result->width = scene.render.width;
  result->height = scene.render.height;
  result->crop = scene.render.crop.width > 0 ? scene.render.crop
                                             : Crop{0, 0, scene.render.width, scene.render.height};
  result->kernel = kernel;
  fill_view(scene, result->crop, result->film_unit, p);
  fill_stats(scene, p, result->stats);
  result->stats.kernel = kernel;
  result->stats.range = range_of(*reach, scene.camera);
  result->stats.smallest_object = reach->smallest_object;
  result->stats.precision = needed_precision(*reach, scene.camera);
  result->stats.precision_reason = precision_reason(*reach, scene.camera);
  parts->kernel = std::move(p);
  parts->reach = std::move(reach);
  result->parts = std::move(parts);
  result->stats.compile_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace

std::shared_ptr<const RenderScene> compile(const Scene& scene, KernelKind kernel,
                                           const RenderScene* previous, Change change) {
  const SceneReach* known =
      previous != nullptr && previous->parts != nullptr ? previous->parts->reach.get() : nullptr;
  const std::shared_ptr<const SceneReach> reach =
      known != nullptr && reach_stands(*known, scene, change)
          ? previous->parts->reach
          : std::make_shared<const SceneReach>(measure_reach(scene, known));
  if (kernel == KernelKind::Auto) kernel = best_kernel(needed_precision(*reach, scene.camera));
  return precision_of(kernel) == Precision::Double
             ? compile_for<double>(scene, kernel, reach, previous, change)
             : compile_for<float>(scene, kernel, reach, previous, change);
}

}  // namespace lightbench
