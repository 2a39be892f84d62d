#include "app/proof/build_scene.h"

#include <memory>

namespace lightbench::proof {

Scene dark_scene(int size) {
  Scene s;
  s.render.width = s.render.height = size;
  s.render.max_depth = 1000;
  return s;
}

Scene furnace_scene(double radiance, int size) {
  Scene s = dark_scene(size);
  s.environment.color = glm::dvec3(radiance);
  return s;
}

Scene wall_scene(double width, int size) {
  Scene s = dark_scene(size);
  add(s, RectangleShape{{-width / 2, -width / 2, -3}, {width, 0, 0}, {0, width, 0}},
      light(glm::dvec3(1)));
  return s;
}

void aim(Scene& scene, const glm::dvec3& from, const glm::dvec3& at) {
  look(scene, from, at, 1e-4);
}

void look(Scene& scene, const glm::dvec3& from, const glm::dvec3& at, double vfov) {
  scene.camera.look_from = from;
  scene.camera.look_at = at;
  // Any up that is not parallel to the view.
  scene.camera.up = glm::dvec3(0.31, 0.87, -0.42);
  scene.camera.vfov = vfov;
}

namespace {

Material colored(MaterialKind kind, const glm::dvec3& color) {
  Material m;
  m.kind = kind;
  m.base_color = color;
  return m;
}

}  // namespace

Material lambertian(const glm::dvec3& albedo) { return colored(MaterialKind::Lambertian, albedo); }

Material mirror(const glm::dvec3& reflectance) { return colored(MaterialKind::Metal, reflectance); }

Material fuzzy_metal(const glm::dvec3& reflectance, double fuzz) {
  Material m = mirror(reflectance);
  m.fuzz = fuzz;
  return m;
}

Material rough_metal(const glm::dvec3& reflectance, double roughness) {
  Material m = mirror(reflectance);
  m.roughness = roughness;
  return m;
}

Material glass(double ior) {
  Material m = colored(MaterialKind::Dielectric, glm::dvec3(1));
  m.ior = ior;
  return m;
}

Material light(const glm::dvec3& radiance, bool two_sided) {
  Material m = colored(MaterialKind::Emissive, glm::dvec3(0));
  m.emissive = radiance;
  m.two_sided = two_sided;
  return m;
}

Material black() { return light(glm::dvec3(0)); }

int add_texture(Scene& scene, const Texture& texture) {
  scene.textures.push_back(texture);
  return static_cast<int>(scene.textures.size()) - 1;
}

int add_mesh(Scene& scene, const Mesh& mesh) {
  scene.meshes.push_back({"", "", std::make_shared<const Mesh>(mesh)});
  return static_cast<int>(scene.meshes.size()) - 1;
}

void add(Scene& scene, const Shape& shape, const Material& material, const Transform& transform) {
  Object o;
  o.shape = shape;
  o.transform = transform;
  o.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(material);
  scene.objects.push_back(o);
}

void add_medium(Scene& scene, const Shape& shape, double density, const glm::dvec3& albedo,
                const Transform& transform) {
  Object o;
  o.shape = shape;
  o.transform = transform;
  o.medium = static_cast<int>(scene.media.size());
  scene.media.push_back({"", density, albedo});
  scene.objects.push_back(o);
}

Transform moved(const glm::dvec3& translation) {
  Transform t;
  t.translation = translation;
  return t;
}

Transform scaled(const glm::dvec3& scale, const glm::dvec3& translation) {
  Transform t = moved(translation);
  t.scale = scale;
  return t;
}

Transform turned(const glm::dvec3& axis, double degrees, const glm::dvec3& translation) {
  Transform t = moved(translation);
  t.axis = axis;
  t.degrees = degrees;
  return t;
}

Mesh octahedron(double radius) {
  const double r = radius;
  Mesh m;
  m.positions = {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
  m.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                 {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return m;
}

std::vector<PlacedShape> closed_shapes(Scene& scene) {
  const glm::dvec3 axis(1, 2, -1);
  Transform stretched = turned(axis, 35);
  stretched.scale = {1.2, 0.5, 0.8};
  Transform mirrored = turned(axis, 20);
  mirrored.scale = {-1.1, 0.9, 1.3};
  const BoxShape box{glm::dvec3(-0.9, -0.7, -1), glm::dvec3(0.9, 0.7, 1)};
  const CylinderShape cylinder{{-0.3, -0.8, 0.1}, {0.3, 0.8, -0.1}, 0.8};
  const PyramidShape pyramid{{glm::dvec3{0, 1.2, 0}, glm::dvec3{-1.2, -0.6, -0.8},
                              glm::dvec3{1.2, -0.6, -0.9}, glm::dvec3{0.1, -0.7, 1.3}}};
  const MeshShape mesh{add_mesh(scene, octahedron(1.2))};
  return {{"sphere", SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, {}},
          {"ellipsoid", SphereShape{{0, 0, 0}, 1, {0, 0, 0}}, stretched},
          {"cylinder", cylinder, {}},
          {"elliptic cylinder", cylinder, stretched},
          {"pyramid", pyramid, turned(axis, 50)},
          {"box", box, {}},
          {"rotated box", box, turned(axis, 40)},
          {"mesh", mesh, turned(axis, 10)},
          {"mirrored mesh", mesh, mirrored}};
}

}  // namespace lightbench::proof
