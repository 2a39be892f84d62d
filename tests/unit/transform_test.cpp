// Object-to-world matrices, and bounds checked against points on the shapes.

#include "core/scene/transform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/scene/bounds.h"

namespace lightbench {
namespace {

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

TEST(Transform, DefaultIsTheIdentity) { EXPECT_EQ(object_to_world(Transform{}), glm::dmat4(1)); }

TEST(Transform, RotationIsRightHanded) {
  Transform t;
  t.axis = {0, 0, 5};
  t.degrees = 90;
  EXPECT_EQ(transform_vector(object_to_world(t), {1, 0, 0}), glm::dvec3(0, 1, 0));
  t.axis = {0, 1, 0};
  t.degrees = 30;
  const glm::dvec3 turned = transform_vector(object_to_world(t), {0, 0, 1});
  EXPECT_NEAR(turned.x, 0.5, 1e-15);
  EXPECT_NEAR(turned.z, std::sqrt(0.75), 1e-15);
}

TEST(Transform, ScaleThenRotateThenTranslate) {
  Transform t;
  t.scale = {2, 3, 4};
  t.axis = {0, 0, 1};
  t.degrees = 90;
  t.translation = {10, 20, 30};
  const glm::dmat4 m = object_to_world(t);
  EXPECT_EQ(transform_point(m, {1, 1, 1}), glm::dvec3(10 - 3, 20 + 2, 30 + 4));
  EXPECT_EQ(transform_vector(m, {1, 1, 1}), glm::dvec3(-3, 2, 4));
}

TEST(Transform, QuarterTurnsAreExact) {
  for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 7)}) {
    for (int quarters = -9; quarters <= 9; ++quarters) {
      Transform t;
      t.axis = axis;
      t.degrees = 90.0 * quarters;
      const glm::dvec3 v = transform_vector(object_to_world(t), {1, 2, 3});
      for (int i = 0; i < 3; ++i) EXPECT_EQ(v[i], std::round(v[i])) << t.degrees;
    }
  }
}

TEST(Transform, RotationsAreRigidForAnyAxisLength) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Transform t;
    t.axis = {normal(engine), normal(engine), normal(engine)};
    t.degrees = 500 * normal(engine);
    const glm::dmat4 unit = object_to_world(t);
    EXPECT_NEAR(glm::determinant(glm::dmat3(unit)), 1, 1e-14);
    EXPECT_LT(distance(transform_vector(unit, t.axis), t.axis), 1e-14 * glm::length(t.axis));
    for (const double length : {1e-18, 1e18}) {
      Transform scaled = t;
      scaled.axis *= length;
      const glm::dvec3 v(1, 2, 3);
      EXPECT_LT(distance(transform_vector(object_to_world(scaled), v), transform_vector(unit, v)),
                1e-14);
    }
  }
}

// ---- bounds
// --------------------------------------------------------------------------------------

class ShapePoints {
 public:
  explicit ShapePoints(unsigned seed) : engine_(seed) {}

  double uniform(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  glm::dvec3 vector() {
    std::normal_distribution<double> normal;
    return {normal(engine_), normal(engine_), normal(engine_)};
  }
  glm::dvec3 unit() { return glm::normalize(vector()); }

  glm::dvec3 on_circle(const glm::dvec3& center, const glm::dvec3& normal, double radius) {
    const glm::dvec3 across = glm::normalize(glm::cross(normal, vector()));
    return center + radius * across;
  }

 private:
  std::mt19937 engine_;
};

struct RandomPoint {
  ShapePoints& random;
  const Scene& scene;

  glm::dvec3 operator()(const SphereShape& s) const {
    const double t =
        random.uniform() < 0.5 ? scene.camera.shutter_open : scene.camera.shutter_close;
    return s.center + t * s.motion + s.radius * random.unit();
  }
  glm::dvec3 operator()(const CylinderShape& s) const {
    return random.on_circle(random.uniform() < 0.5 ? s.p0 : s.p1, s.p1 - s.p0, s.radius);
  }
  glm::dvec3 operator()(const DiscShape& s) const {
    return random.on_circle(s.center, s.normal, s.radius);
  }
  glm::dvec3 operator()(const RectangleShape& s) const {
    return s.corner + std::round(random.uniform()) * s.edge_u +
           std::round(random.uniform()) * s.edge_v;
  }
  glm::dvec3 operator()(const TriangleShape& s) const {
    const double pick = random.uniform(0, 3);
    return pick < 1 ? s.a : pick < 2 ? s.b : s.c;
  }
  glm::dvec3 operator()(const PyramidShape& s) const {
    return s.vertices[static_cast<std::size_t>(random.uniform(0, 4))];
  }
  glm::dvec3 operator()(const BoxShape& s) const {
    glm::dvec3 p;
    for (int i = 0; i < 3; ++i) p[i] = random.uniform() < 0.5 ? s.min[i] : s.max[i];
    return p;
  }
  glm::dvec3 operator()(const MeshShape& s) const {
    const auto& positions = scene.meshes[static_cast<std::size_t>(s.mesh)].data->positions;
    return positions[static_cast<std::size_t>(
        random.uniform(0, static_cast<double>(positions.size())))];
  }
};

TEST(Bounds, HoldEveryPointOfEveryShapeAndNoMore) {
  ShapePoints random(3);
  Scene scene;
  scene.camera.shutter_open = -0.5;
  scene.camera.shutter_close = 2;
  scene.meshes.emplace_back().name = "corners";
  Mesh mesh;  // the corners of its box, so that its box is tight after any transform
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1, (i & 2) / 2, (i & 4) / 4);
  scene.meshes[0].data = std::make_shared<const Mesh>(mesh);
  const std::vector<Bounds> meshes = all_mesh_bounds(scene);
  for (int round = 0; round < 50; ++round) {
    const glm::dvec3 a = random.vector();
    const glm::dvec3 b = random.vector();
    const glm::dvec3 c = random.vector();
    const double r = random.uniform(0.1, 2);
    const Shape shapes[] = {SphereShape{a, r, b},
                            CylinderShape{a, b, r},
                            DiscShape{a, b, r},
                            RectangleShape{a, b, c},
                            TriangleShape{a, b, c},
                            PyramidShape{{a, b, c, a + b}},
                            BoxShape{glm::min(a, b), glm::max(a, b)},
                            MeshShape{0}};
    for (const Shape& shape : shapes) {
      Object object;
      object.shape = shape;
      object.transform = {
          random.vector(),
          random.vector(),
          random.uniform(-360, 360),
          {random.uniform(0.5, 2), -random.uniform(0.5, 2), random.uniform(0.5, 2)}};
      const Bounds bounds = object_bounds(object, scene.camera, meshes);
      const glm::dmat4 matrix = object_to_world(object.transform);
      Bounds seen;
      for (int i = 0; i < 4000; ++i)
        seen.add(transform_point(matrix, std::visit(RandomPoint{random, scene}, shape)));
      for (int axis = 0; axis < 3; ++axis) {
        const double slack = 1e-12 * (1 + glm::length(bounds.size()));
        EXPECT_GE(seen.min[axis], bounds.min[axis] - slack) << "shape " << shape.index();
        EXPECT_LE(seen.max[axis], bounds.max[axis] + slack) << "shape " << shape.index();
        EXPECT_GT(seen.size()[axis], 0.97 * bounds.size()[axis]) << "shape " << shape.index();
      }
    }
  }
}

TEST(Bounds, OfASceneSkipHiddenObjects) {
  Scene scene;
  EXPECT_TRUE(scene_bounds(scene).empty());
  scene.objects.resize(2);
  scene.objects[0].shape = BoxShape{{0, 0, 0}, {1, 2, 3}};
  scene.objects[1].shape = BoxShape{{-100, 0, 0}, {1, 2, 3}};
  scene.objects[1].visible = false;
  const Bounds bounds = scene_bounds(scene);
  EXPECT_EQ(bounds.min, glm::dvec3(0));
  EXPECT_EQ(bounds.max, glm::dvec3(1, 2, 3));
  EXPECT_EQ(bounds.center(), glm::dvec3(0.5, 1, 1.5));
}

// ---- camera numbers and emission
// -----------------------------------------------------------------

TEST(SceneCamera, FocalLengthIsThePhotographers) {
  Camera camera;
  camera.vfov = vfov_from_focal_length(50, 24);
  EXPECT_NEAR(camera.vfov, 26.9915, 1e-4);  // a full-frame 50 mm lens
  EXPECT_NEAR(focal_length(camera), 50, 1e-12);
  camera.lens_radius = lens_radius_from_f_stop(1.8, 50);
  EXPECT_NEAR(camera.lens_radius, 0.05 / 1.8 / 2, 1e-15);  // metres
  EXPECT_NEAR(f_stop(camera), 1.8, 1e-12);
  camera.lens_radius = 0;
  EXPECT_TRUE(std::isinf(f_stop(camera)));
}

TEST(SceneMaterial, EmitsWhenColourAndStrengthDo) {
  Material material;
  EXPECT_FALSE(emits(material));
  material.emissive = {0, 0, 0.1};
  EXPECT_TRUE(emits(material));
  material.emissive_strength = 0;
  EXPECT_FALSE(emits(material));
}

}  // namespace
}  // namespace lightbench
