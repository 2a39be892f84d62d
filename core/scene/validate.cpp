#include "core/scene/validate.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>
#include <unordered_set>

#include "core/error.h"
#include "core/scene/json_cursor.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

constexpr int kLargestSide = 65536;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 28;
constexpr int kMostSamples = 1'000'000'000;
constexpr double kBrightest = 1e12;

void validate_camera(const Camera& camera) {
  const Place place{"/camera"};
  check_point(place / "/lookFrom", camera.look_from);
  check_point(place / "/lookAt", camera.look_at);
  const glm::dvec3 view = camera.look_at - camera.look_from;
  if (!(glm::length(view) >= kSmallestLength))
    out_of_range(place / "/lookAt", "a point other than lookFrom", to_text(camera.look_at));
  check_direction(place / "/up", camera.up);
  if (!(glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) > 1e-6)) {
    out_of_range(place / "/up", "a direction not parallel to the view from lookFrom to lookAt",
                 to_text(camera.up));
  }
  if (!(camera.vfov > 0 && camera.vfov < 180))
    out_of_range(place / "/vfov", "an angle between 0 and 180 degrees", to_text(camera.vfov));
  // Below this the picture plane is narrower than the resolution of a double.
  check_in(place / "/vfov", camera.vfov, 1e-6, 180 - 1e-6);
  check_positive_length(place / "/sensorHeight", camera.sensor_height);
  check_in(place / "/lensRadius", camera.lens_radius, 0, kLargestLength);
  check_positive_length(place / "/focusDistance", camera.focus_distance);
  check_in(place / "/shutter", camera.shutter_open, -1e6, 1e6);
  check_in(place / "/shutter", camera.shutter_close, -1e6, 1e6);
  if (camera.shutter_open > camera.shutter_close) {
    out_of_range(place / "/shutter", "open before close",
                 fmt::format("[{}, {}]", camera.shutter_open, camera.shutter_close));
  }
}

void validate_render(const RenderSettings& render) {
  const Place place{"/render"};
  check_in(place / "/resolution", render.width, 1, kLargestSide);
  check_in(place / "/resolution", render.height, 1, kLargestSide);
  if (std::int64_t{render.width} * render.height > kMostPixels) {
    out_of_range(place / "/resolution", fmt::format("at most {} pixels", kMostPixels),
                 fmt::format("{} x {}", render.width, render.height));
  }
  const Crop& crop = render.crop;
  const bool whole = crop.width == 0 && crop.height == 0 && crop.x == 0 && crop.y == 0;
  const bool inside = crop.x >= 0 && crop.y >= 0 && crop.width > 0 && crop.height > 0 &&
                      crop.x < render.width && crop.width <= render.width - crop.x &&
                      crop.y < render.height && crop.height <= render.height - crop.y;
  if (!whole && !inside) {
    out_of_range(
        place / "/crop",
        fmt::format("[x, y, width, height] inside {} x {} pixels", render.width, render.height),
        fmt::format("[{}, {}, {}, {}]", crop.x, crop.y, crop.width, crop.height));
  }
  check_in(place / "/spp", render.spp, 0, kMostSamples);
  check_at_least(place / "/timeLimit", render.time_limit, 0);
  check_in(place / "/maxDepth", render.max_depth, 1, 10'000);
  check_in(place / "/rouletteDepth", render.roulette_depth, 0, 10'000);
  if (!(render.filter_radius > 0)) {
    out_of_range(place / "/filter/radius", "a positive number", to_text(render.filter_radius));
  }
  check_in(place / "/filter/radius", render.filter_radius, 0, 16);
  if (render.snapshots.size() > 1000) {
    out_of_range(place / "/snapshots", "at most 1000 counts",
                 std::to_string(render.snapshots.size()));
  }
  for (const int count : render.snapshots) check_in(place / "/snapshots", count, 1, kMostSamples);
}

void validate_environment(const Environment& environment) {
  const Place place{"/environment"};
  check_in(place / "/color", environment.color, 0, kBrightest);
  check_in(place / "/horizon", environment.horizon, 0, kBrightest);
  check_in(place / "/strength", environment.strength, 0, kBrightest);
  check_in(place / "/rotation", environment.rotation, -1e6, 1e6);
  if (environment.kind == EnvironmentKind::Image && environment.image == nullptr)
    out_of_range(place / "/file", "an image file", "none");
}

void validate_texture(const Place& place, const Texture& texture) {
  check_in(place / "/colorA", texture.color_a, 0, 1);
  check_in(place / "/colorB", texture.color_b, 0, 1);
  check_positive_length(place / "/scale", texture.scale);
  check_in(place / "/octaves", texture.octaves, 1, 16);
  if (texture.kind == TextureKind::Image && texture.image == nullptr)
    out_of_range(place / "/file", "an image file", "none");
}

void check_reference(const Place& place, int index, std::size_t count) {
  if (index != kNone && (index < 0 || static_cast<std::size_t>(index) >= count))
    out_of_range(place, fmt::format("-1 or an index below {}", count), std::to_string(index));
}

void validate_material(const Place& place, const Material& material, std::size_t texture_count) {
  check_in(place / "/baseColor", material.base_color, 0, 1);
  check_reference(place / "/baseColorTexture", material.base_color_texture, texture_count);
  check_in(place / "/fuzz", material.fuzz, 0, 1);
  check_in(place / "/roughness", material.roughness, 0, 1);
  if (material.fuzz > 0 && material.roughness > 0) {
    out_of_range(place / "/roughness", "0 with fuzz above 0 (they exclude each other)",
                 to_text(material.roughness));
  }
  if (!(material.ior > 0)) out_of_range(place / "/ior", "a positive number", to_text(material.ior));
  check_in(place / "/ior", material.ior, 0.01, 100);
  check_in(place / "/emissive", material.emissive, 0, kBrightest);
  check_in(place / "/emissiveStrength", material.emissive_strength, 0, kBrightest);
  check_reference(place / "/emissiveTexture", material.emissive_texture, texture_count);
}

void validate_medium(const Place& place, const Medium& medium) {
  check_positive_length(place / "/density", medium.density);
  check_in(place / "/albedo", medium.albedo, 0, 1);
}

void validate_transform(const Place& place, const Transform& transform) {
  check_point(place / "/transform/translation", transform.translation);
  check_direction(place / "/transform/rotation/axis", transform.axis);
  check_in(place / "/transform/rotation/degrees", transform.degrees, -1e6, 1e6);
  for (int axis = 0; axis < 3; ++axis) {
    const double size = std::abs(transform.scale[axis]);
    if (!(size >= 1e-12 && size <= 1e12)) {
      out_of_range(place / "/transform/scale", "factors from 1e-12 to 1e+12, either sign",
                   to_text(transform.scale));
    }
  }
}

void validate_object(const Place& place, const Object& object, const Scene& scene) {
  validate_shape(place, object.shape, scene.meshes.size());
  validate_transform(place, object.transform);
  check_reference(place / "/material", object.material, scene.materials.size());
  check_reference(place / "/medium", object.medium, scene.media.size());
  if (object.medium != kNone && !is_closed(object.shape)) {
    out_of_range(place / "/medium", "a closed shape (sphere, cylinder, pyramid, box or mesh)",
                 "an open one");
  }
}

/// Names must be there, unless `optional`, and be different.
template <class T>
void validate_names(const char* list, const std::vector<T>& elements, bool optional) {
  std::unordered_set<std::string_view> seen;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::string& name = elements[i].name;
    const Place place{list, i, "/name"};
    if (name.empty() && optional) continue;
    if (name.empty()) out_of_range(place, "a name", "\"\"");
    if (!seen.insert(name).second)
      out_of_range(place, "a name of its own", describe(Json(name)) + " for a second time");
  }
}

}  // namespace

std::string Place::pointer() const {
  if (index == kNoIndex) return std::string(list) + field;
  return std::string(list) + "/" + std::to_string(index) + field;
}

void out_of_range(const Place& place, const std::string& what, const std::string& got) {
  throw Error(ErrorKind::Scene, place.pointer() + ": expected " + what + ", got " + got);
}

std::string to_text(double value) { return fmt::format("{}", value); }
std::string to_text(const glm::dvec3& value) {
  return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
}

void check_in(const Place& place, double value, double low, double high) {
  if (!(value >= low && value <= high))
    out_of_range(place, fmt::format("a number from {} to {}", low, high), to_text(value));
}

void check_in(const Place& place, const glm::dvec3& value, double low, double high) {
  for (int i = 0; i < 3; ++i) {
    if (!(value[i] >= low && value[i] <= high))
      out_of_range(place, fmt::format("components from {} to {}", low, high), to_text(value));
  }
}

void check_at_least(const Place& place, double value, double low) {
  if (!(value >= low && std::isfinite(value)))
    out_of_range(place, fmt::format("a number of at least {}", low), to_text(value));
}

void check_positive_length(const Place& place, double value) {
  if (!(value > 0)) out_of_range(place, "a positive number", to_text(value));
  check_in(place, value, kSmallestLength, kLargestLength);
}

void check_point(const Place& place, const glm::dvec3& value) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(value[i]) <= kLargestLength))
      out_of_range(place, "finite components of at most 1e+18", to_text(value));
  }
}

void check_direction(const Place& place, const glm::dvec3& value) {
  check_point(place, value);
  if (!(glm::length(value) >= kSmallestLength))
    out_of_range(place, "a vector that is not zero", to_text(value));
}

void validate(const Scene& scene) {
  validate_camera(scene.camera);
  validate_render(scene.render);
  check_in(Place{"/display"} / "/exposure", scene.display.exposure, -100, 100);
  validate_environment(scene.environment);
  validate_names("/textures", scene.textures, false);
  validate_names("/materials", scene.materials, false);
  validate_names("/media", scene.media, false);
  validate_names("/meshes", scene.meshes, false);
  validate_names("/objects", scene.objects, true);
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    validate_texture({"/textures", i}, scene.textures[i]);
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    validate_material({"/materials", i}, scene.materials[i], scene.textures.size());
  for (std::size_t i = 0; i < scene.media.size(); ++i)
    validate_medium({"/media", i}, scene.media[i]);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (scene.meshes[i].data == nullptr)
      out_of_range({"/meshes", i, "/file"}, "a mesh file, or positions and triangles", "none");
    validate_mesh({"/meshes", i}, *scene.meshes[i].data);
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    validate_object({"/objects", i}, scene.objects[i], scene);
}

}  // namespace lightbench
