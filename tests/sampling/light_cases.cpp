#include "tests/sampling/light_cases.h"

#include <utility>

namespace lightbench {
namespace {

Object object(Shape shape, glm::dvec3 scale = glm::dvec3(1), double degrees = 0,
              glm::dvec3 axis = {1, 2, 3}) {
  Object o;
  o.shape = shape;
  o.transform.scale = scale;
  o.transform.axis = axis;
  o.transform.degrees = degrees;
  return o;
}

/// Points outside every shape here, which lie within about 1.5 of the origin.
const std::vector<std::pair<const char*, glm::dvec3>> kOutside = {
    {"near", {0.7, 1.6, 1.1}}, {"beside", {-2.3, 0.05, 0.02}}, {"axis", {0, 2.5, 0}},
    {"below", {0.4, -2, 0.3}}, {"far", {14, 9, -17}},          {"very far", {700, 1500, -900}},
};

void add(std::vector<LightCase>& cases, const std::string& name, const Object& o,
         const std::vector<std::pair<const char*, glm::dvec3>>& more) {
  for (const auto& [where, from] : kOutside) cases.push_back({name + " from " + where, o, from});
  for (const auto& [where, from] : more) cases.push_back({name + " from " + where, o, from});
}

std::vector<LightCase> make_cases() {
  std::vector<LightCase> c;
  add(c, "sphere", object(SphereShape{}),
      {{"inside", {0.3, 0.2, -0.4}}, {"centre", {0, 0, 0}}, {"close", {0.8, 1.0, 0.3}}});
  add(c, "ellipsoid", object(SphereShape{}, {1.2, 0.5, 0.8}, 40),
      {{"inside", {0.1, 0.1, -0.2}}, {"close", {0, 0, 1.3}}});
  add(c, "cylinder", object(CylinderShape{{-0.3, -0.8, 0.1}, {0.5, 0.7, -0.2}, 0.5}),
      {{"inside", {0.1, 0, 0}}, {"close", {0.1, 0.1, 0.65}}});
  add(c, "elliptic cylinder",
      object(CylinderShape{{0, -0.8, 0}, {0, 0.7, 0}, 0.6}, {1.4, 0.7, 0.6}, 30),
      {{"inside", {0.1, 0, 0}}});
  add(c, "disc", object(DiscShape{{0.1, 0, 0.2}, {0, 1, 0}, 1.1}),
      {{"close", {0.2, 0.15, 0.3}}, {"its plane", {2, 1e-3, 0.2}}, {"above rim", {1.1, 0.4, 0.2}}});
  add(c, "elliptic disc", object(DiscShape{{0, 0, 0}, {1, 3, 2}, 0.9}, {1.4, 0.6, 0.9}, 50),
      {{"close", {0.2, 0.25, 0.3}}});
  add(c, "rectangle", object(RectangleShape{{-0.7, 0.1, -0.5}, {0, 0, 1.2}, {1.5, 0, 0}}),
      {{"close", {0.1, 0.2, 0.3}}, {"its plane", {2, 0.101, 0.2}}, {"edge", {0.8, 0.5, 0.2}}});
  add(c, "tilted rectangle",
      object(RectangleShape{{-0.7, 0, -0.5}, {0, 0, 1.2}, {1.5, 0, 0}}, glm::dvec3(0.8), 67), {});
  add(c, "parallelogram", object(RectangleShape{{-0.9, 0, -0.5}, {0.6, 0, 1}, {1.2, 0.3, -0.1}}),
      {{"close", {0.1, 0.4, 0.2}}});
  add(c, "triangle", object(TriangleShape{{-0.8, -0.3, 0}, {0.9, -0.2, 0.3}, {0, 0.8, -0.5}}),
      {{"close", {0, 0.1, 0.12}}, {"its plane", {1.4, -0.146, 0.389}}});
  add(c, "pyramid", object(PyramidShape{}), {{"inside", {0, 0.3, -0.2}}});
  add(c, "box", object(BoxShape{{-0.6, -0.4, -0.3}, {0.5, 0.7, 0.8}}, {1, 0.8, 1.1}, 25),
      {{"inside", {0, 0.1, 0.2}}, {"close", {0.2, 0.8, 0.2}}});
  add(c, "mesh", object(MeshShape{0}, {0.9, 1.1, 0.8}, 35), {});
  return c;
}

}  // namespace

Mesh light_mesh() {
  Mesh m;
  m.positions = {{-0.8, -0.3, 0},  {0.9, -0.2, 0.3}, {0, 0.8, -0.5},
                 {0.1, -0.6, 0.9}, {0.7, 0.4, 0.8},  {-0.5, 0.3, -0.9}};
  m.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 4, 2}, {5, 0, 2}};
  return m;
}

const std::vector<LightCase>& light_cases() {
  static const std::vector<LightCase> cases = make_cases();
  return cases;
}

Scene light_scene(const Object& object) {
  Scene scene;
  Material glow;
  glow.kind = MaterialKind::Emissive;
  glow.emissive = glm::dvec3(1);
  glow.two_sided = true;
  scene.materials = {glow};
  if (std::holds_alternative<MeshShape>(object.shape)) {
    scene.meshes = {{"", "", std::make_shared<const Mesh>(light_mesh())}};
  }
  scene.objects = {object};
  scene.objects[0].material = 0;
  return scene;
}

}  // namespace lightbench
