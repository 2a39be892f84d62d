#include "core/scene/json_read.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <unordered_map>

#include "core/scene/json_names.h"
#include "core/scene/suggest.h"

namespace lightbench {
namespace {

/// Names of a list to indices; elements that come later in the document may be referred to as well,
/// because every list is read before the objects that use it.
using NameIndex = std::unordered_map<std::string, int>;

template <class T>
NameIndex index_names(const std::vector<T>& list) {
  NameIndex index;
  for (std::size_t i = 0; i < list.size(); ++i)
    index.emplace(list[i].name, static_cast<int>(i));  // duplicates are refused by validate()
  return index;
}

struct References {
  NameIndex textures, materials, media, meshes;
};

int resolve(const JsonCursor& cursor, const NameIndex& index, const char* what) {
  std::string name;
  cursor.read(name);
  if (const auto found = index.find(name); found != index.end()) return found->second;
  std::vector<std::string_view> known;
  for (const auto& [key, value] : index) known.emplace_back(key);
  std::sort(known.begin(), known.end());
  cursor.fail("no " + std::string(what) + " is named " + describe(cursor.value()) +
              did_you_mean(name, known));
}

/// Reads the array at `key`, if there, calling read(cursor, element) for each.
template <class T, class Read>
void read_list(JsonObject& parent, const char* key, std::vector<T>& out, Read read) {
  if (!parent.has(key)) return;
  const JsonCursor list = parent.member(key);
  list.expect_array();
  out.resize(list.size());
  for (std::size_t i = 0; i < out.size(); ++i) read(list.element(i), out[i]);
}

void read_camera(const JsonCursor& cursor, Camera& camera) {
  JsonObject fields(cursor);
  fields.optional("lookFrom", camera.look_from);
  fields.optional("lookAt", camera.look_at);
  fields.optional("up", camera.up);
  fields.optional("sensorHeight", camera.sensor_height);
  fields.optional("focusDistance", camera.focus_distance);
  const bool vfov = fields.optional("vfov", camera.vfov);
  if (double millimetres = 0; fields.optional("focalLength", millimetres)) {
    if (vfov) cursor.fail("expected vfov or focalLength, got both");
    if (!(millimetres > 0)) fields.member("focalLength").expected("a positive number");
    camera.vfov = vfov_from_focal_length(millimetres, camera.sensor_height);
  }
  const bool radius = fields.optional("lensRadius", camera.lens_radius);
  if (double stop = 0; fields.optional("fStop", stop)) {
    if (radius) cursor.fail("expected lensRadius or fStop, got both");
    if (!(stop > 0)) fields.member("fStop").expected("a positive number");
    camera.lens_radius = lens_radius_from_f_stop(stop, focal_length(camera));
  }
  if (glm::dvec2 shutter{}; fields.optional("shutter", shutter)) {
    camera.shutter_open = shutter[0];
    camera.shutter_close = shutter[1];
  }
  fields.finish();
}

void read_render(const JsonCursor& cursor, RenderSettings& render) {
  JsonObject fields(cursor);
  if (std::array<int, 2> size{}; fields.optional("resolution", size)) {
    render.width = size[0];
    render.height = size[1];
  }
  if (std::array<int, 4> crop{}; fields.optional("crop", crop))
    render.crop = {crop[0], crop[1], crop[2], crop[3]};
  fields.optional("spp", render.spp);
  fields.optional("timeLimit", render.time_limit);
  fields.optional("maxDepth", render.max_depth);
  fields.optional("rouletteDepth", render.roulette_depth);
  fields.optional_name("strategy", kStrategies, render.strategy);
  fields.optional_name("lightChoice", kLightChoices, render.light_choice);
  fields.optional_name("sampler", kSamplers, render.sampler);
  fields.optional("seed", render.seed);
  fields.optional("adaptive", render.adaptive);
  fields.optional("snapshots", render.snapshots);
  if (fields.has("filter")) {
    const JsonCursor at = fields.member("filter");
    JsonObject filter(at);
    filter.optional_name("type", kFilterKinds, render.filter);
    filter.optional("radius", render.filter_radius);
    filter.finish();
  }
  fields.finish();
}

void read_display(const JsonCursor& cursor, Display& display) {
  JsonObject fields(cursor);
  fields.optional("exposure", display.exposure);
  fields.optional_name("toneMap", kToneMaps, display.tone_map);
  fields.finish();
}

void read_environment(const JsonCursor& cursor, Environment& environment) {
  JsonObject fields(cursor);
  fields.optional_name("type", kEnvironmentKinds, environment.kind);
  fields.optional("color", environment.color);
  fields.optional("horizon", environment.horizon);
  fields.optional("strength", environment.strength);
  fields.optional("rotation", environment.rotation);
  fields.optional("file", environment.file);
  fields.finish();
}

void read_texture(const JsonCursor& cursor, Texture& texture) {
  JsonObject fields(cursor);
  fields.required("name", texture.name);
  fields.member("type").read_name(kTextureKinds, texture.kind);
  fields.optional("colorA", texture.color_a);
  fields.optional("colorB", texture.color_b);
  fields.optional("scale", texture.scale);
  fields.optional("useUv", texture.use_uv);
  fields.optional("octaves", texture.octaves);
  fields.optional("seed", texture.seed);
  fields.optional_name("wrap", kWrapModes, texture.wrap);
  fields.optional("file", texture.file);
  fields.optional("srgb", texture.srgb);
  fields.finish();
}

void read_material(const JsonCursor& cursor, const References& names, Material& material) {
  JsonObject fields(cursor);
  fields.required("name", material.name);
  fields.member("type").read_name(kMaterialKinds, material.kind);
  fields.optional("baseColor", material.base_color);
  fields.optional("fuzz", material.fuzz);
  fields.optional("roughness", material.roughness);
  fields.optional("ior", material.ior);
  fields.optional("emissive", material.emissive);
  fields.optional("emissiveStrength", material.emissive_strength);
  fields.optional("twoSided", material.two_sided);
  if (fields.has("baseColorTexture")) {
    material.base_color_texture =
        resolve(fields.member("baseColorTexture"), names.textures, "texture");
  }
  if (fields.has("emissiveTexture")) {
    material.emissive_texture =
        resolve(fields.member("emissiveTexture"), names.textures, "texture");
  }
  fields.finish();
}

void read_medium(const JsonCursor& cursor, Medium& medium) {
  JsonObject fields(cursor);
  fields.required("name", medium.name);
  fields.optional("density", medium.density);
  fields.optional("albedo", medium.albedo);
  fields.finish();
}

void read_mesh(const JsonCursor& cursor, MeshAsset& asset) {
  JsonObject fields(cursor);
  fields.required("name", asset.name);
  const bool file = fields.optional("file", asset.file);
  Mesh mesh;
  const bool positions = fields.optional("positions", mesh.positions);
  const bool triangles = fields.optional("triangles", mesh.triangles);
  fields.optional("normals", mesh.normals);
  fields.optional("uvs", mesh.uvs);
  fields.finish();
  if (file && (positions || triangles))
    cursor.fail("expected file, or positions and triangles, got both");
  if (!file && !(positions && triangles)) cursor.fail("expected file, or positions and triangles");
  if (!file) asset.data = std::make_shared<const Mesh>(std::move(mesh));
}

// A unit quaternion is (axis sin(a/2), cos(a/2)), as in glTF.
void read_quaternion(const JsonCursor& cursor, Transform& transform) {
  std::array<double, 4> q{};
  cursor.read(q);
  const glm::dvec3 axis(q[0], q[1], q[2]);
  const double sine = glm::length(axis);
  if (!(sine > 0) && q[3] == 0) cursor.expected("a quaternion [x, y, z, w] that is not zero");
  if (!(sine > 0)) return;
  transform.axis = axis / sine;
  transform.degrees = glm::degrees(2 * std::atan2(sine, q[3]));
}

void read_transform(const JsonCursor& cursor, Transform& transform) {
  JsonObject fields(cursor);
  fields.optional("translation", transform.translation);
  if (fields.has("rotation")) {
    const JsonCursor rotation = fields.member("rotation");
    if (rotation.value().is_array()) {
      read_quaternion(rotation, transform);
    } else {
      JsonObject parts(rotation);
      parts.optional("axis", transform.axis);
      parts.optional("degrees", transform.degrees);
      parts.finish();
    }
  }
  if (fields.has("scale")) {
    const JsonCursor scale = fields.member("scale");
    if (scale.value().is_number()) {
      transform.scale = glm::dvec3(scale.value().get<double>());
    } else if (scale.value().is_array()) {
      scale.read(transform.scale);
    } else {
      scale.expected("a number or an array of 3 numbers");
    }
  }
  fields.finish();
}

struct ReadShape {
  JsonObject& fields;
  const References& names;

  void operator()(SphereShape& s) const {
    fields.optional("center", s.center);
    fields.optional("radius", s.radius);
    fields.optional("motion", s.motion);
  }
  void operator()(CylinderShape& s) const {
    fields.optional("p0", s.p0);
    fields.optional("p1", s.p1);
    fields.optional("radius", s.radius);
  }
  void operator()(DiscShape& s) const {
    fields.optional("center", s.center);
    fields.optional("normal", s.normal);
    fields.optional("radius", s.radius);
  }
  void operator()(RectangleShape& s) const {
    fields.optional("corner", s.corner);
    fields.optional("edgeU", s.edge_u);
    fields.optional("edgeV", s.edge_v);
  }
  void operator()(TriangleShape& s) const {
    fields.optional("a", s.a);
    fields.optional("b", s.b);
    fields.optional("c", s.c);
  }
  void operator()(PyramidShape& s) const { fields.optional("vertices", s.vertices); }
  void operator()(BoxShape& s) const {
    fields.optional("min", s.min);
    fields.optional("max", s.max);
  }
  void operator()(MeshShape& s) const {
    s.mesh = resolve(fields.member("mesh"), names.meshes, "mesh");
  }
};

template <std::size_t... I>
Shape default_shape(std::size_t index, std::index_sequence<I...>) {
  Shape shape;
  static_cast<void>(((index == I ? (shape.emplace<I>(), true) : false) || ...));
  return shape;
}

void read_object(const JsonCursor& cursor, const References& names, Object& object) {
  JsonObject fields(cursor);
  std::size_t type = 0;
  fields.member("type").read_name(kShapeTypes, type);
  object.shape = default_shape(type, std::make_index_sequence<std::variant_size_v<Shape>>());
  std::visit(ReadShape{fields, names}, object.shape);
  fields.optional("name", object.name);
  fields.optional("visible", object.visible);
  if (fields.has("transform")) {
    const JsonCursor transform = fields.member("transform");
    read_transform(transform, object.transform);
  }
  if (fields.has("material"))
    object.material = resolve(fields.member("material"), names.materials, "material");
  if (fields.has("medium")) object.medium = resolve(fields.member("medium"), names.media, "medium");
  fields.finish();
}

void read_version(JsonObject& fields) {
  const JsonCursor version = fields.member("lightbench");
  if (!version.value().is_number() || version.value().get<double>() != kFormatVersion)
    version.expected("format version " + std::to_string(kFormatVersion));
}

}  // namespace

Scene read_scene(const Json& document) {
  const JsonCursor root(document);
  JsonObject fields(root);
  read_version(fields);
  Scene scene;
  References names;
  if (fields.has("camera")) read_camera(fields.member("camera"), scene.camera);
  if (fields.has("render")) read_render(fields.member("render"), scene.render);
  if (fields.has("display")) read_display(fields.member("display"), scene.display);
  if (fields.has("environment")) read_environment(fields.member("environment"), scene.environment);
  read_list(fields, "textures", scene.textures, read_texture);
  names.textures = index_names(scene.textures);
  read_list(fields, "materials", scene.materials,
            [&](const JsonCursor& at, Material& material) { read_material(at, names, material); });
  read_list(fields, "media", scene.media, read_medium);
  read_list(fields, "meshes", scene.meshes, read_mesh);
  names.materials = index_names(scene.materials);
  names.media = index_names(scene.media);
  names.meshes = index_names(scene.meshes);
  read_list(fields, "objects", scene.objects,
            [&](const JsonCursor& at, Object& object) { read_object(at, names, object); });
  fields.finish();
  return scene;
}

}  // namespace lightbench
