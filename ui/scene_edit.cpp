#include "ui/scene_edit.h"

#include <algorithm>
#include <cctype>
#include <glm/geometric.hpp>

#include "core/scene/bounds.h"
#include "ui/navigation.h"

namespace lightbench::ui {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Calls `f` with the list of `kind`; the lists have different element types, each with a name.
template <class SceneT, class F>
auto with_list(SceneT& scene, ItemKind kind, F&& f) {
  switch (kind) {
    case ItemKind::Material:
      return f(scene.materials);
    case ItemKind::Texture:
      return f(scene.textures);
    case ItemKind::Medium:
      return f(scene.media);
    case ItemKind::None:
    case ItemKind::Object:
      break;
  }
  return f(scene.objects);
}

template <class T>
Selection append(Scene& scene, std::vector<T>& list, ItemKind kind, T item) {
  item.name = unique_name(scene, kind, item.name);
  list.push_back(std::move(item));
  return {kind, static_cast<int>(list.size()) - 1};
}

int surface_material(Scene& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!emits(scene.materials[i])) return static_cast<int>(i);
  }
  return add_material(scene, MaterialKind::Lambertian).index;
}

/// A length that looks right next to what the camera sees.
double typical_size(const Scene& scene) {
  const double distance = glm::length(scene.camera.look_at - scene.camera.look_from);
  return distance > 0 ? 0.08 * distance : 1.0;
}

Shape make_shape(std::size_t kind, double s) {
  switch (kind) {
    case 1:
      return CylinderShape{{0, -s, 0}, {0, s, 0}, 0.6 * s};
    case 2:
      return DiscShape{{0, 0, 0}, {0, 1, 0}, s};
    case 3:
      return RectangleShape{{-s, 0, s}, {2 * s, 0, 0}, {0, 0, -2 * s}};
    case 4:
      return TriangleShape{{-s, -s, 0}, {s, -s, 0}, {0, s, 0}};
    case 5:
      return PyramidShape{{glm::dvec3{0, s, 0}, {-s, -s, -s}, {s, -s, -s}, {0, -s, s}}};
    case 6:
      return BoxShape{glm::dvec3(-s), glm::dvec3(s)};
    default:
      return SphereShape{{0, 0, 0}, s, {0, 0, 0}};
  }
}

void forget_index(int& reference, int removed, int replacement) {
  if (reference == removed) {
    reference = replacement;
  } else if (reference > removed) {
    --reference;
  }
}

}  // namespace

const std::vector<const char*>& shape_names() {
  static const std::vector<const char*> names{"Sphere",   "Cylinder", "Disc", "Rectangle",
                                              "Triangle", "Pyramid",  "Box",  "Mesh"};
  return names;
}

int item_count(const Scene& scene, ItemKind kind) {
  if (kind == ItemKind::None) return 0;
  return with_list(scene, kind, [](const auto& list) { return static_cast<int>(list.size()); });
}

const std::string& item_name(const Scene& scene, Selection selection) {
  switch (selection.kind) {
    case ItemKind::Material:
      return scene.materials[at(selection.index)].name;
    case ItemKind::Texture:
      return scene.textures[at(selection.index)].name;
    case ItemKind::Medium:
      return scene.media[at(selection.index)].name;
    case ItemKind::None:
    case ItemKind::Object:
      break;
  }
  return scene.objects[at(selection.index)].name;
}

bool is_valid(const Scene& scene, Selection selection) {
  return selection.index >= 0 && selection.index < item_count(scene, selection.kind);
}

std::string unique_name(const Scene& scene, ItemKind kind, std::string_view wanted) {
  const auto taken = [&](const std::string& name) {
    return with_list(scene, kind, [&](const auto& list) {
      return std::any_of(list.begin(), list.end(), [&](const auto& x) { return x.name == name; });
    });
  };
  std::string name(wanted.empty() ? "unnamed" : wanted);
  if (!taken(name)) return name;
  // "sphere 2" counts on from 2 rather than becoming "sphere 2 2".
  std::string stem = name;
  while (!stem.empty() && std::isdigit(static_cast<unsigned char>(stem.back())) != 0)
    stem.pop_back();
  if (stem.size() == name.size() || stem.empty() || stem.back() != ' ') stem = name + " ";
  for (int n = 2;; ++n) {
    std::string candidate = stem + std::to_string(n);
    if (!taken(candidate)) return candidate;
  }
}

Scene new_scene() {
  Scene scene;
  scene.camera.look_from = {0, 1.5, 6};
  scene.camera.look_at = {0, 1, 0};
  scene.camera.focus_distance = 6;
  scene.environment.kind = EnvironmentKind::Gradient;
  scene.environment.color = {0.5, 0.7, 1.0};
  scene.environment.horizon = glm::dvec3(1);
  Material floor;
  floor.name = "Floor";
  floor.base_color = glm::dvec3(0.5);
  Material matte;
  matte.name = "Matte";
  matte.base_color = {0.7, 0.3, 0.1};
  scene.materials = {floor, matte};
  Object ground;
  ground.name = "Floor";
  ground.shape = DiscShape{{0, 0, 0}, {0, 1, 0}, 100};
  ground.material = 0;
  Object sphere;
  sphere.name = "Sphere";
  sphere.shape = SphereShape{{0, 1, 0}, 1, {0, 0, 0}};
  sphere.material = 1;
  scene.objects = {ground, sphere};
  return scene;
}

Selection add_object(Scene& scene, std::size_t shape) {
  Object object;
  object.name = shape_names()[shape];
  object.shape = make_shape(shape, typical_size(scene));
  object.transform.translation = scene.camera.look_at;
  object.material = surface_material(scene);
  return append(scene, scene.objects, ItemKind::Object, std::move(object));
}

Selection add_light(Scene& scene) {
  Material material;
  material.name = "Light";
  material.kind = MaterialKind::Emissive;
  material.emissive = glm::dvec3(1);
  material.emissive_strength = 10;
  const Selection emitter = append(scene, scene.materials, ItemKind::Material, std::move(material));
  const double size = typical_size(scene);
  Object object;
  object.name = "Light";
  object.shape = DiscShape{{0, 0, 0}, {0, -1, 0}, size};
  object.transform.translation = scene.camera.look_at + 3 * size * camera_axes(scene.camera).up;
  object.material = emitter.index;
  return append(scene, scene.objects, ItemKind::Object, std::move(object));
}

Selection add_material(Scene& scene, MaterialKind kind) {
  Material material;
  material.kind = kind;
  switch (kind) {
    case MaterialKind::Lambertian:
      material.name = "Matte";
      break;
    case MaterialKind::Metal:
      material.name = "Metal";
      break;
    case MaterialKind::Dielectric:
      material.name = "Glass";
      material.base_color = glm::dvec3(1);
      break;
    case MaterialKind::Emissive:
      material.name = "Light";
      material.emissive = glm::dvec3(1);
      material.emissive_strength = 10;
      break;
  }
  return append(scene, scene.materials, ItemKind::Material, std::move(material));
}

Selection add_texture(Scene& scene, TextureKind kind) {
  Texture texture;
  texture.kind = kind;
  switch (kind) {
    case TextureKind::Constant:
      texture.name = "Colour";
      break;
    case TextureKind::Image:
      texture.name = "Image";
      break;
    case TextureKind::Checker:
      texture.name = "Checker";
      break;
    case TextureKind::Noise:
      texture.name = "Noise";
      break;
    case TextureKind::Turbulence:
      texture.name = "Turbulence";
      break;
    case TextureKind::Marble:
      texture.name = "Marble";
      break;
  }
  // A pattern whose cells are far below a pixel would look like a plain grey.
  if (kind != TextureKind::Constant && kind != TextureKind::Image) {
    texture.scale = 1 / typical_size(scene);
  }
  return append(scene, scene.textures, ItemKind::Texture, std::move(texture));
}

Selection add_medium(Scene& scene) {
  Medium medium;
  medium.name = "Smoke";
  medium.density = 1 / typical_size(scene);
  return append(scene, scene.media, ItemKind::Medium, std::move(medium));
}

Selection add_mesh(Scene& scene, std::string_view name, const std::string& file,
                   std::shared_ptr<const Mesh> mesh) {
  std::string asset_name(name);
  for (int n = 2; std::any_of(scene.meshes.begin(), scene.meshes.end(),
                              [&](const MeshAsset& m) { return m.name == asset_name; });
       ++n) {
    asset_name = std::string(name) + " " + std::to_string(n);
  }
  scene.meshes.push_back({asset_name, file, std::move(mesh)});
  Object object;
  object.name = asset_name;
  object.shape = MeshShape{static_cast<int>(scene.meshes.size()) - 1};
  object.material = surface_material(scene);
  return append(scene, scene.objects, ItemKind::Object, std::move(object));
}

Selection duplicate(Scene& scene, Selection selection) {
  if (!is_valid(scene, selection)) return selection;
  const std::string name = unique_name(scene, selection.kind, item_name(scene, selection));
  const int copy_index = selection.index + 1;
  with_list(scene, selection.kind, [&](auto& list) {
    auto copy = list[at(selection.index)];
    copy.name = name;
    list.insert(list.begin() + copy_index, std::move(copy));
  });
  const auto shift = [&](int& reference) {
    if (reference >= copy_index) ++reference;
  };
  switch (selection.kind) {
    case ItemKind::Object: {
      Object& copy = scene.objects[at(copy_index)];
      const Bounds bounds = object_bounds(copy, scene.camera, all_mesh_bounds(scene));
      if (!bounds.empty()) {
        copy.transform.translation +=
            0.6 * glm::length(bounds.size()) * camera_axes(scene.camera).right;
      }
      break;
    }
    case ItemKind::Material:
      for (Object& object : scene.objects) shift(object.material);
      break;
    case ItemKind::Medium:
      for (Object& object : scene.objects) shift(object.medium);
      break;
    case ItemKind::Texture:
      for (Material& material : scene.materials) {
        shift(material.base_color_texture);
        shift(material.emissive_texture);
      }
      break;
    case ItemKind::None:
      break;
  }
  return {selection.kind, copy_index};
}

void rename(Scene& scene, Selection selection, std::string_view name) {
  if (!is_valid(scene, selection) || name.empty() || item_name(scene, selection) == name) return;
  const std::string unique = unique_name(scene, selection.kind, name);
  with_list(scene, selection.kind, [&](auto& list) { list[at(selection.index)].name = unique; });
}

Selection remove(Scene& scene, Selection selection) {
  if (!is_valid(scene, selection)) return {};
  const int removed = selection.index;
  with_list(scene, selection.kind, [&](auto& list) { list.erase(list.begin() + removed); });
  const int last = item_count(scene, selection.kind) - 1;
  const auto clear_medium = [&](Object& object) {
    forget_index(object.medium, removed, kNone);
    if (object.medium == kNone && object.material == kNone) {
      object.material = surface_material(scene);
    }
  };
  switch (selection.kind) {
    case ItemKind::Material: {
      const bool used = std::any_of(scene.objects.begin(), scene.objects.end(),
                                    [&](const Object& o) { return o.material == removed; });
      if (used && last < 0) add_material(scene, MaterialKind::Lambertian);
      const int neighbour = std::max(0, std::min(removed, last));
      for (Object& object : scene.objects) forget_index(object.material, removed, neighbour);
      break;
    }
    case ItemKind::Medium:
      std::for_each(scene.objects.begin(), scene.objects.end(), clear_medium);
      break;
    case ItemKind::Texture:
      for (Material& material : scene.materials) {
        forget_index(material.base_color_texture, removed, kNone);
        forget_index(material.emissive_texture, removed, kNone);
      }
      break;
    case ItemKind::Object:
    case ItemKind::None:
      break;
  }
  const int next = std::min(removed, item_count(scene, selection.kind) - 1);
  return next < 0 ? Selection{} : Selection{selection.kind, next};
}

void make_material_unique(Scene& scene, int object) {
  const int material = scene.objects[at(object)].material;
  if (material == kNone) return;
  scene.objects[at(object)].material = duplicate(scene, {ItemKind::Material, material}).index;
}

int use_count(const Scene& scene, Selection selection) {
  const auto objects_with = [&](auto&& predicate) {
    return static_cast<int>(std::count_if(scene.objects.begin(), scene.objects.end(), predicate));
  };
  switch (selection.kind) {
    case ItemKind::Material:
      return objects_with([&](const Object& o) { return o.material == selection.index; });
    case ItemKind::Medium:
      return objects_with([&](const Object& o) { return o.medium == selection.index; });
    case ItemKind::Texture:
      return static_cast<int>(
          std::count_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) {
            return m.base_color_texture == selection.index || m.emissive_texture == selection.index;
          }));
    case ItemKind::Object:
    case ItemKind::None:
      break;
  }
  return 0;
}

}  // namespace lightbench::ui
