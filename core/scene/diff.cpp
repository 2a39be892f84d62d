#include <algorithm>

#include "core/scene/change.h"

namespace lightbench {
namespace {

/// `bit` if the values differ.
template <class T>
Change when(const T& before, const T& after, Change bit) {
  return before == after ? Change::None : bit;
}

// The sensor only turns the field of view into a focal length for display.
Change diff_camera(const Camera& a, const Camera& b) {
  return when(a.look_from, b.look_from, Change::Camera) |
         when(a.look_at, b.look_at, Change::Camera) | when(a.up, b.up, Change::Camera) |
         when(a.vfov, b.vfov, Change::Camera) |
         when(a.sensor_height, b.sensor_height, Change::Display) |
         when(a.lens_radius, b.lens_radius, Change::Camera) |
         when(a.focus_distance, b.focus_distance, Change::Camera) |
         when(a.shutter_open, b.shutter_open, Change::Camera) |
         when(a.shutter_close, b.shutter_close, Change::Camera);
}

Change diff_render(const RenderSettings& a, const RenderSettings& b) {
  return when(a.width, b.width, Change::Resolution) | when(a.height, b.height, Change::Resolution) |
         when(a.crop, b.crop, Change::Resolution) | when(a.spp, b.spp, Change::Target) |
         when(a.time_limit, b.time_limit, Change::Target) |
         when(a.snapshots, b.snapshots, Change::Target) |
         when(a.max_depth, b.max_depth, Change::Settings) |
         when(a.roulette_depth, b.roulette_depth, Change::Settings) |
         when(a.strategy, b.strategy, Change::Settings) |
         when(a.light_choice, b.light_choice, Change::Settings) |
         when(a.sampler, b.sampler, Change::Settings) | when(a.seed, b.seed, Change::Settings) |
         when(a.adaptive, b.adaptive, Change::Settings) |
         when(a.filter, b.filter, Change::Settings) |
         when(a.filter_radius, b.filter_radius, Change::Settings);
}

// File names are names: what a file holds is the payload, compared by pointer.
Change diff_environment(const Environment& a, const Environment& b) {
  return when(a.kind, b.kind, Change::Environment) | when(a.color, b.color, Change::Environment) |
         when(a.horizon, b.horizon, Change::Environment) |
         when(a.strength, b.strength, Change::Environment) |
         when(a.rotation, b.rotation, Change::Environment) |
         when(a.image, b.image, Change::Environment) | when(a.file, b.file, Change::Display);
}

Change diff_element(const Texture& a, const Texture& b) {
  return when(a.name, b.name, Change::Display) | when(a.file, b.file, Change::Display) |
         when(a.kind, b.kind, Change::Textures) | when(a.color_a, b.color_a, Change::Textures) |
         when(a.color_b, b.color_b, Change::Textures) | when(a.scale, b.scale, Change::Textures) |
         when(a.use_uv, b.use_uv, Change::Textures) | when(a.octaves, b.octaves, Change::Textures) |
         when(a.seed, b.seed, Change::Textures) | when(a.wrap, b.wrap, Change::Textures) |
         when(a.srgb, b.srgb, Change::Textures) | when(a.image, b.image, Change::Textures);
}

Change diff_element(const Material& a, const Material& b) {
  return when(a.name, b.name, Change::Display) | when(a.kind, b.kind, Change::Materials) |
         when(a.base_color, b.base_color, Change::Materials) |
         when(a.base_color_texture, b.base_color_texture, Change::Materials) |
         when(a.fuzz, b.fuzz, Change::Materials) |
         when(a.roughness, b.roughness, Change::Materials) | when(a.ior, b.ior, Change::Materials) |
         when(a.emissive, b.emissive, Change::Materials) |
         when(a.emissive_strength, b.emissive_strength, Change::Materials) |
         when(a.emissive_texture, b.emissive_texture, Change::Materials) |
         when(a.two_sided, b.two_sided, Change::Materials);
}

Change diff_element(const Medium& a, const Medium& b) {
  return when(a.name, b.name, Change::Display) | when(a.density, b.density, Change::Materials) |
         when(a.albedo, b.albedo, Change::Materials);
}

Change diff_element(const MeshAsset& a, const MeshAsset& b) {
  return when(a.name, b.name, Change::Display) | when(a.file, b.file, Change::Display) |
         when(a.data, b.data, Change::Meshes);
}

Change diff_element(const Object& a, const Object& b) {
  return when(a.name, b.name, Change::Display) | when(a.shape, b.shape, Change::Geometry) |
         when(a.visible, b.visible, Change::Geometry) |
         when(a.transform, b.transform, Change::Transforms) |
         when(a.material, b.material, Change::Materials) |
         when(a.medium, b.medium, Change::Materials);
}

/// Elements are compared in pairs; a different number of them is `bit`.
template <class T>
Change diff_lists(const std::vector<T>& before, const std::vector<T>& after, Change bit) {
  Change change = before.size() == after.size() ? Change::None : bit;
  const std::size_t count = std::min(before.size(), after.size());
  for (std::size_t i = 0; i < count; ++i) change |= diff_element(before[i], after[i]);
  return change;
}

}  // namespace

Change diff(const Scene& before, const Scene& after) {
  return diff_camera(before.camera, after.camera) | diff_render(before.render, after.render) |
         when(before.display, after.display, Change::Display) |
         diff_environment(before.environment, after.environment) |
         diff_lists(before.textures, after.textures, Change::Textures) |
         diff_lists(before.materials, after.materials, Change::Materials) |
         diff_lists(before.media, after.media, Change::Materials) |
         diff_lists(before.meshes, after.meshes, Change::Meshes) |
         diff_lists(before.objects, after.objects, Change::Geometry);
}

}  // namespace lightbench
