#include "tests/unit/shape_gallery.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lightbench {

const std::vector<NamedShape>& shape_gallery() {
  static const std::vector<NamedShape> shapes = {
      {"sphere", SphereShape{{0.2, -0.1, 0.3}, 0.8}, true},
      {"moving sphere", SphereShape{{0.2, -0.1, 0.3}, 0.6, {0.5, -0.7, 0.3}}, true},
      {"cylinder", CylinderShape{{-0.3, -0.8, 0.1}, {0.5, 0.7, -0.2}, 0.5}, true},
      {"flat cylinder", CylinderShape{{0, 0.1, 0}, {0, 0.2, 0}, 1}, true},
      {"disc", DiscShape{{0.1, 0.2, -0.1}, {1, 2, -0.5}, 0.9}, false},
      {"rectangle", RectangleShape{{-0.5, -0.2, 0.1}, {1, 0.2, 0}, {-0.1, 0.5, 0.9}}, false},
      {"sheared parallelogram", RectangleShape{{-0.5, -0.6, 0.1}, {1, 0.2, 0}, {0.6, 0.9, 0.2}},
       false},
      {"triangle", TriangleShape{{-0.8, -0.3, 0}, {0.9, -0.2, 0.3}, {0, 0.8, -0.5}}, false},
      {"pyramid", PyramidShape{}, true},
      {"inverted pyramid",
       PyramidShape{{glm::dvec3{0, -1, 0.2}, {-0.5, 0.4, 0.7}, {0.8, 0.3, 0.1}, {-0.1, 0.6, -0.8}}},
       true},
      {"box", BoxShape{{-0.6, -0.4, -0.3}, {0.5, 0.7, 0.8}}, true},
      {"mesh", MeshShape{0}, false},
  };
  return shapes;
}

std::shared_ptr<const Mesh> gallery_mesh() {
  static const std::shared_ptr<const Mesh> mesh = [] {
    auto m = std::make_shared<Mesh>();
    constexpr std::uint32_t kRings = 8, kSpokes = 12;
    for (std::uint32_t i = 0; i <= kRings; ++i) {
      for (std::uint32_t j = 0; j <= kSpokes; ++j) {
        const double theta = std::numbers::pi * i / kRings,
                     phi = 2 * std::numbers::pi * (j % kSpokes) / kSpokes;
        const double r = 0.8 + 0.05 * std::sin(3 * phi) * std::sin(theta);
        m->positions.emplace_back(r * std::sin(theta) * std::cos(phi), r * std::cos(theta),
                                  -r * std::sin(theta) * std::sin(phi));
        m->uvs.emplace_back(static_cast<double>(j) / kSpokes, 1 - static_cast<double>(i) / kRings);
      }
    }
    for (std::uint32_t i = 0; i < kRings; ++i) {
      for (std::uint32_t j = 0; j < kSpokes; ++j) {
        const std::uint32_t a = i * (kSpokes + 1) + j, b = a + kSpokes + 1;
        if (i + 1 < kRings) m->triangles.push_back({a, b, b + 1});
        if (i > 0) m->triangles.push_back({a, b + 1, a + 1});
      }
    }
    return m;
  }();
  return mesh;
}

const std::vector<NamedTransform>& gallery_transforms() {
  static const std::vector<NamedTransform> transforms = {
      {"identity", {}},
      {"rotated and moved", {{3, -1, 2}, {1, 2, -0.5}, 77, glm::dvec3(1)}},
      {"scaled", {{0.5, 0, 0}, {0, 1, 0}, 30, glm::dvec3(2.5)}},
      {"tiny and far", {{400, 0, -300}, {0, 0, 1}, -20, glm::dvec3(1e-3)}},
      {"stretched", {{0, 1, 0}, {1, 1, 0}, 50, {1.5, 0.4, 0.9}}},
      {"mirrored", {{0, 0, 1}, {0, 1, 1}, 20, {-1, 1, 1}}},
      {"mirrored and stretched", {{1, 0, 1}, {2, 1, 1}, 130, {0.7, -1.3, 1}}},
  };
  return transforms;
}

Scene scene_of(const Shape& shape, const Transform& transform) {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {{"ball", "", gallery_mesh()}};
  Object o;
  o.shape = shape;
  o.transform = transform;
  o.material = 0;
  scene.objects = {o};
  return scene;
}

}  // namespace lightbench
