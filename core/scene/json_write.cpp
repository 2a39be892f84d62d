#include "core/scene/json_write.h"

#include <cmath>

#include "core/scene/json_names.h"

namespace lightbench {
namespace {

// Whole numbers are written without a fraction, as a person would; the value is the same.
OrderedJson to_json(double value) {
  constexpr double kExact = 1e15;
  const bool whole = value == std::floor(value) && std::abs(value) < kExact;
  if (whole && !(value == 0 && std::signbit(value))) return static_cast<std::int64_t>(value);
  return value;
}
OrderedJson to_json(int value) { return value; }
OrderedJson to_json(std::uint32_t value) { return value; }
OrderedJson to_json(bool value) { return value; }
OrderedJson to_json(const std::string& value) { return value; }
OrderedJson to_json(const glm::dvec2& v) {
  return OrderedJson::array({to_json(v.x), to_json(v.y)});
}
OrderedJson to_json(const glm::dvec3& v) {
  return OrderedJson::array({to_json(v.x), to_json(v.y), to_json(v.z)});
}
OrderedJson to_json(const Crop& c) { return OrderedJson::array({c.x, c.y, c.width, c.height}); }
OrderedJson to_json(const std::array<std::uint32_t, 3>& t) {
  return OrderedJson::array({t[0], t[1], t[2]});
}
template <class T>
OrderedJson to_json(const std::vector<T>& list) {
  OrderedJson result = OrderedJson::array();
  for (const T& element : list) result.push_back(to_json(element));
  return result;
}

/// Two values that are equal but for the sign of a zero are not the same value.
template <class T>
bool same(const T& a, const T& b) {
  return a == b;
}
bool same(double a, double b) { return a == b && std::signbit(a) == std::signbit(b); }
bool same(const glm::dvec3& a, const glm::dvec3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// Leaves out what the reader would assume.
template <class T>
void put(OrderedJson& json, const char* key, const T& value, const T& assumed) {
  if (!same(value, assumed)) json[key] = to_json(value);
}
template <class T, std::size_t N>
void put_name(OrderedJson& json, const char* key, const Names<T, N>& names, T value, T assumed) {
  if (value != assumed) json[key] = name_of(names, value);
}
void put_section(OrderedJson& json, const char* key, OrderedJson section) {
  if (!section.empty()) json[key] = std::move(section);
}

std::string relative_name(const std::string& file, const std::filesystem::path& directory) {
  const auto from = std::filesystem::absolute("." / directory).lexically_normal();
  const auto to = std::filesystem::absolute(file).lexically_normal();
  return to.lexically_relative(from).generic_string();
}

OrderedJson write_camera(const Camera& camera) {
  const Camera assumed;
  OrderedJson json = OrderedJson::object();
  put(json, "lookFrom", camera.look_from, assumed.look_from);
  put(json, "lookAt", camera.look_at, assumed.look_at);
  put(json, "up", camera.up, assumed.up);
  put(json, "vfov", camera.vfov, assumed.vfov);
  put(json, "sensorHeight", camera.sensor_height, assumed.sensor_height);
  put(json, "lensRadius", camera.lens_radius, assumed.lens_radius);
  put(json, "focusDistance", camera.focus_distance, assumed.focus_distance);
  put(json, "shutter", glm::dvec2(camera.shutter_open, camera.shutter_close),
      glm::dvec2(assumed.shutter_open, assumed.shutter_close));
  return json;
}

OrderedJson write_render(const RenderSettings& render) {
  const RenderSettings assumed;
  OrderedJson json = OrderedJson::object();
  if (render.width != assumed.width || render.height != assumed.height)
    json["resolution"] = {render.width, render.height};
  put(json, "crop", render.crop, assumed.crop);
  put(json, "spp", render.spp, assumed.spp);
  put(json, "timeLimit", render.time_limit, assumed.time_limit);
  put(json, "maxDepth", render.max_depth, assumed.max_depth);
  put(json, "rouletteDepth", render.roulette_depth, assumed.roulette_depth);
  put_name(json, "strategy", kStrategies, render.strategy, assumed.strategy);
  put_name(json, "lightChoice", kLightChoices, render.light_choice, assumed.light_choice);
  put_name(json, "sampler", kSamplers, render.sampler, assumed.sampler);
  put(json, "seed", render.seed, assumed.seed);
  put(json, "adaptive", render.adaptive, assumed.adaptive);
  OrderedJson filter = OrderedJson::object();
  put_name(filter, "type", kFilterKinds, render.filter, assumed.filter);
  put(filter, "radius", render.filter_radius, assumed.filter_radius);
  put_section(json, "filter", std::move(filter));
  put(json, "snapshots", render.snapshots, assumed.snapshots);
  return json;
}

OrderedJson write_display(const Display& display) {
  const Display assumed;
  OrderedJson json = OrderedJson::object();
  put(json, "exposure", display.exposure, assumed.exposure);
  put_name(json, "toneMap", kToneMaps, display.tone_map, assumed.tone_map);
  return json;
}

OrderedJson write_environment(const Environment& environment,
                              const std::filesystem::path& directory) {
  const Environment assumed;
  OrderedJson json = OrderedJson::object();
  put_name(json, "type", kEnvironmentKinds, environment.kind, assumed.kind);
  put(json, "color", environment.color, assumed.color);
  put(json, "horizon", environment.horizon, assumed.horizon);
  put(json, "strength", environment.strength, assumed.strength);
  put(json, "rotation", environment.rotation, assumed.rotation);
  if (!environment.file.empty()) json["file"] = relative_name(environment.file, directory);
  return json;
}

OrderedJson write_texture(const Texture& texture, const std::filesystem::path& directory) {
  const Texture assumed;
  OrderedJson json{{"name", texture.name}, {"type", name_of(kTextureKinds, texture.kind)}};
  if (!texture.file.empty()) json["file"] = relative_name(texture.file, directory);
  put(json, "srgb", texture.srgb, assumed.srgb);
  put_name(json, "wrap", kWrapModes, texture.wrap, assumed.wrap);
  put(json, "colorA", texture.color_a, assumed.color_a);
  put(json, "colorB", texture.color_b, assumed.color_b);
  put(json, "scale", texture.scale, assumed.scale);
  put(json, "useUv", texture.use_uv, assumed.use_uv);
  put(json, "octaves", texture.octaves, assumed.octaves);
  put(json, "seed", texture.seed, assumed.seed);
  return json;
}

OrderedJson write_material(const Material& material, const Scene& scene) {
  const Material assumed;
  OrderedJson json{{"name", material.name}, {"type", name_of(kMaterialKinds, material.kind)}};
  const auto put_texture = [&](const char* key, int texture) {
    if (texture != kNone) json[key] = scene.textures[static_cast<std::size_t>(texture)].name;
  };
  put(json, "baseColor", material.base_color, assumed.base_color);
  put_texture("baseColorTexture", material.base_color_texture);
  put(json, "fuzz", material.fuzz, assumed.fuzz);
  put(json, "roughness", material.roughness, assumed.roughness);
  put(json, "ior", material.ior, assumed.ior);
  put(json, "emissive", material.emissive, assumed.emissive);
  put(json, "emissiveStrength", material.emissive_strength, assumed.emissive_strength);
  put_texture("emissiveTexture", material.emissive_texture);
  put(json, "twoSided", material.two_sided, assumed.two_sided);
  return json;
}

OrderedJson write_medium(const Medium& medium) {
  const Medium assumed;
  OrderedJson json{{"name", medium.name}};
  put(json, "density", medium.density, assumed.density);
  put(json, "albedo", medium.albedo, assumed.albedo);
  return json;
}

OrderedJson write_mesh(const MeshAsset& mesh, const std::filesystem::path& directory) {
  OrderedJson json{{"name", mesh.name}};
  if (!mesh.file.empty()) {
    json["file"] = relative_name(mesh.file, directory);
    return json;
  }
  json["positions"] = to_json(mesh.data->positions);
  json["triangles"] = to_json(mesh.data->triangles);
  if (!mesh.data->normals.empty()) json["normals"] = to_json(mesh.data->normals);
  if (!mesh.data->uvs.empty()) json["uvs"] = to_json(mesh.data->uvs);
  return json;
}

struct WriteShape {
  OrderedJson& json;
  const Scene& scene;

  // A shape is written whole: its default is no more natural than any other.
  void operator()(const SphereShape& s) const {
    json["center"] = to_json(s.center);
    json["radius"] = to_json(s.radius);
    put(json, "motion", s.motion, glm::dvec3(0));
  }
  void operator()(const CylinderShape& s) const {
    json["p0"] = to_json(s.p0);
    json["p1"] = to_json(s.p1);
    json["radius"] = to_json(s.radius);
  }
  void operator()(const DiscShape& s) const {
    json["center"] = to_json(s.center);
    json["normal"] = to_json(s.normal);
    json["radius"] = to_json(s.radius);
  }
  void operator()(const RectangleShape& s) const {
    json["corner"] = to_json(s.corner);
    json["edgeU"] = to_json(s.edge_u);
    json["edgeV"] = to_json(s.edge_v);
  }
  void operator()(const TriangleShape& s) const {
    json["a"] = to_json(s.a);
    json["b"] = to_json(s.b);
    json["c"] = to_json(s.c);
  }
  void operator()(const PyramidShape& s) const {
    for (const glm::dvec3& vertex : s.vertices) json["vertices"].push_back(to_json(vertex));
  }
  void operator()(const BoxShape& s) const {
    json["min"] = to_json(s.min);
    json["max"] = to_json(s.max);
  }
  void operator()(const MeshShape& s) const {
    json["mesh"] = scene.meshes[static_cast<std::size_t>(s.mesh)].name;
  }
};

OrderedJson write_transform(const Transform& transform) {
  const Transform assumed;
  OrderedJson json = OrderedJson::object();
  put(json, "translation", transform.translation, assumed.translation);
  OrderedJson rotation = OrderedJson::object();
  put(rotation, "axis", transform.axis, assumed.axis);
  put(rotation, "degrees", transform.degrees, assumed.degrees);
  put_section(json, "rotation", std::move(rotation));
  const glm::dvec3& scale = transform.scale;
  if (scale.x == scale.y && scale.y == scale.z) {
    put(json, "scale", scale.x, 1.0);
  } else {
    json["scale"] = to_json(scale);
  }
  return json;
}

OrderedJson write_object(const Object& object, const Scene& scene) {
  OrderedJson json = OrderedJson::object();
  put(json, "name", object.name, std::string());
  json["type"] = name_of(kShapeTypes, object.shape.index());
  std::visit(WriteShape{json, scene}, object.shape);
  put_section(json, "transform", write_transform(object.transform));
  if (object.material != kNone)
    json["material"] = scene.materials[static_cast<std::size_t>(object.material)].name;
  if (object.medium != kNone)
    json["medium"] = scene.media[static_cast<std::size_t>(object.medium)].name;
  put(json, "visible", object.visible, true);
  return json;
}

template <class T, class Write>
void put_list(OrderedJson& json, const char* key, const std::vector<T>& list, Write write) {
  for (const T& element : list) json[key].push_back(write(element));
}

}  // namespace

OrderedJson write_scene(const Scene& scene, const std::filesystem::path& directory) {
  OrderedJson json{{"lightbench", kFormatVersion}};
  put_section(json, "camera", write_camera(scene.camera));
  put_section(json, "render", write_render(scene.render));
  put_section(json, "display", write_display(scene.display));
  put_section(json, "environment", write_environment(scene.environment, directory));
  put_list(json, "textures", scene.textures,
           [&](const Texture& texture) { return write_texture(texture, directory); });
  put_list(json, "materials", scene.materials,
           [&](const Material& material) { return write_material(material, scene); });
  put_list(json, "media", scene.media, write_medium);
  put_list(json, "meshes", scene.meshes,
           [&](const MeshAsset& mesh) { return write_mesh(mesh, directory); });
  put_list(json, "objects", scene.objects,
           [&](const Object& object) { return write_object(object, scene); });
  return json;
}

}  // namespace lightbench
