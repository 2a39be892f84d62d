// Which precision compile() chooses, and that it is enough where it is chosen.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "core/compile/render_scene.h"
#include "core/compile/scene_reach.h"
#include "core/query/rays.h"
#include "core/scene/scene_io.h"

namespace lightbench {
namespace {

using glm::dvec3;

Scene spheres(std::initializer_list<SphereShape> shapes) {
  Scene scene;
  scene.render.width = scene.render.height = 4;
  scene.camera.look_from = {0, 0, 5};
  scene.materials.emplace_back();
  for (const SphereShape& s : shapes) {
    Object object;
    object.name = "r" + std::to_string(s.radius);
    object.shape = s;
    object.material = 0;
    scene.objects.push_back(object);
  }
  return scene;
}

TEST(Precision, RangeIsTheFarthestOverTheSmallest) {
  const Scene scene = spheres({{.radius = 2}, {.center = {30, 0, 0}, .radius = 0.5}});
  const SceneReach reach = measure_reach(scene);
  // The median of the two centres is the second: the first reaches 32 from there.
  EXPECT_DOUBLE_EQ(range_of(reach, scene.camera), 32 / 0.5);
  EXPECT_EQ(reach.smallest_object, "r0.500000");
  Camera far = scene.camera;
  far.look_from = {30, 0, 1000};
  EXPECT_DOUBLE_EQ(range_of(reach, far), 1000 / 0.5);
  EXPECT_EQ(range_of(measure_reach(spheres({})), far), 1);
}

TEST(Precision, EveryShapeHasASmallestFeature) {
  const auto smallest = [](const Shape& shape, const dvec3& scale) {
    Scene scene = spheres({{}});
    scene.objects[0].shape = shape;
    scene.objects[0].transform.scale = scale;
    return measure_reach(scene).smallest;
  };
  const dvec3 one(1);
  EXPECT_DOUBLE_EQ(smallest(CylinderShape{.p0 = {0, 0, 0}, .p1 = {0, 3, 0}, .radius = 4}, one), 3);
  EXPECT_DOUBLE_EQ(smallest(CylinderShape{.p0 = {0, 0, 0}, .p1 = {0, 9, 0}, .radius = 4}, one), 4);
  EXPECT_DOUBLE_EQ(smallest(DiscShape{.radius = 0.25}, one), 0.25);
  EXPECT_DOUBLE_EQ(smallest(RectangleShape{.edge_u = {3, 4, 0}, .edge_v = {3, 0, 0}}, one),
                   12 / 5.0);
  EXPECT_DOUBLE_EQ(smallest(TriangleShape{.a = {0, 0, 0}, .b = {4, 0, 0}, .c = {1, 0.5, 0}}, one),
                   0.5);
  EXPECT_DOUBLE_EQ(smallest(BoxShape{.min = {0, 0, 0}, .max = {1, 0.125, 2}}, one), 0.125);
  EXPECT_NEAR(
      smallest(PyramidShape{.vertices = {dvec3{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0.01, 0}}}, one),
      0.01, 1e-5);
  EXPECT_DOUBLE_EQ(smallest(SphereShape{.radius = 2}, {4, -0.5, 3}), 1);
}

TEST(Precision, AutoChoosesItByTheRange) {
  const Scene fine = spheres({{.radius = 1}});
  EXPECT_EQ(compile(fine, KernelKind::Auto)->kernel, best_kernel(Precision::Float));
  const Scene vast = spheres({{.radius = 1}, {.center = {0, 0, -5e5}, .radius = 1e5}});
  const auto scene = compile(vast, KernelKind::Auto);
  EXPECT_EQ(scene->kernel, best_kernel(Precision::Double));
  EXPECT_EQ(scene->stats.kernel, scene->kernel);
  EXPECT_GT(scene->stats.range, kFloatRange);
  EXPECT_EQ(scene->stats.smallest_object, "r1.000000");
}

TEST(Precision, ACameraThatFliesOffTakesTheSceneWithIt) {
  Scene scene = spheres({{.radius = 1}});
  const auto near = compile(scene, KernelKind::Auto);
  scene.camera.look_from = {0, 0, 1e6};
  const auto far = compile(scene, KernelKind::Auto, near.get(), Change::Camera);
  EXPECT_EQ(far->kernel, best_kernel(Precision::Double));
  scene.camera.look_from = {0, 0, 5};
  const auto back = compile(scene, KernelKind::Auto, far.get(), Change::Camera);
  EXPECT_EQ(back->kernel, best_kernel(Precision::Float));
}

// Two surfaces that float would confuse are a fine feature too.
TEST(Precision, GapsThatFloatWouldLoseAskForDouble) {
  const auto precision_with = [](const Shape& a, const Shape& b) {
    Scene scene = spheres({});
    for (const Shape& shape : {a, b}) {
      Object object;
      object.name = "it";
      object.shape = shape;
      object.material = 0;
      scene.objects.push_back(object);
    }
    return precision_of(compile(scene, KernelKind::Auto)->kernel);
  };
  const auto box = [](double low, double high) {
    return BoxShape{.min = {-1, low, -1}, .max = {1, high, 1}};
  };
  const auto plate = [](double y) {
    return RectangleShape{.corner = {-0.5, y, 0.3}, .edge_u = {0.9, 0, 0}, .edge_v = {0, 0, -0.8}};
  };
  const CylinderShape can{.p0 = {0, 0, 0}, .p1 = {0, 1, 0}, .radius = 0.5};
  const CylinderShape label{.p0 = {0, 0.2, 0}, .p1 = {0, 0.8, 0}, .radius = 0.5 + 1e-8};
  struct Case {
    const char* what;
    Shape a, b;
    Precision expected;
  };
  const std::vector<Case> cases{
      {"shell", SphereShape{.radius = 1}, SphereShape{.radius = 1 + 1e-9}, Precision::Double},
      {"eccentric shell", SphereShape{.radius = 1},
       SphereShape{.center = {1e-8, 0, 0}, .radius = 1 + 2e-8}, Precision::Double},
      {"shell with air", SphereShape{.radius = 1}, SphereShape{.radius = 1.001}, Precision::Float},
      {"shells of two sizes", SphereShape{.center = {0, 0, -1}, .radius = 1},
       SphereShape{.center = {0, 0, -1}, .radius = 1.0001}, Precision::Float},
      {"the same ball twice", SphereShape{.radius = 1}, SphereShape{.radius = 1}, Precision::Float},
      {"balls that touch", SphereShape{.radius = 1}, SphereShape{.center = {2, 0, 0}, .radius = 1},
       Precision::Float},
      {"moves away", SphereShape{.radius = 1},
       SphereShape{.radius = 1 + 1e-9, .motion = {0.5, 0, 0}}, Precision::Float},
      {"decal", box(0, 1), plate(1 + 1e-8), Precision::Double},
      {"decal upside down", plate(-1e-8), box(0, 1), Precision::Double},
      {"decal well above", box(0, 1), plate(1.001), Precision::Float},
      {"small decal", box(0, 1),
       RectangleShape{.corner = {0, 1 + 1e-8, 0}, .edge_u = {0.02, 0, 0}, .edge_v = {0, 0, -0.02}},
       Precision::Double},
      {"plate on a box", box(0, 1), plate(1), Precision::Float},
      {"plate rounded onto a box", box(0, 1), plate(1 + 4e-16), Precision::Float},
      {"box beside", box(0, 1), BoxShape{.min = {1, 1 + 1e-8, -1}, .max = {2, 2, 1}},
       Precision::Float},
      {"disc", plate(0), DiscShape{.center = {0, 1e-8, 0}, .normal = {0, -3, 0}, .radius = 0.2},
       Precision::Double},
      {"slanted plates",
       RectangleShape{.corner = {0, 0, 0}, .edge_u = {1, 1, 0}, .edge_v = {0, 0, 1}},
       RectangleShape{.corner = {1e-8, -1e-8, 0}, .edge_u = {1, 1, 0}, .edge_v = {0, 0, 1}},
       Precision::Double},
      {"slanted plates, the other way",
       RectangleShape{.corner = {0, 0, 0}, .edge_u = {0.1, -0.1, 0}, .edge_v = {0.7, 0, 0.7}},
       RectangleShape{
           .corner = {1e-8, 1e-8, -1e-8}, .edge_u = {0.3, -0.3, 0}, .edge_v = {0.7, 0, 0.7}},
       Precision::Double},
      {"label on a can", can, label, Precision::Double},
      {"cans end to end", can,
       CylinderShape{.p0 = {0, 1, 0}, .p1 = {0, 2, 0}, .radius = 0.5 + 1e-8}, Precision::Float},
      {"pyramid on a plate", plate(0),
       PyramidShape{.vertices = {dvec3{-1, 1e-8, -1}, {1, 1e-8, -1}, {0, 1e-8, 1}, {0, 1, 0}}},
       Precision::Double}};
  for (const Case& c : cases) EXPECT_EQ(precision_with(c.a, c.b), c.expected) << c.what;
}

/// A ball of 2 n^2 triangles around 0; every corner with an index of its own for each triangle that
/// it belongs to if `split`.
Mesh ball_mesh(double radius, unsigned n, bool split = false) {
  Mesh mesh;
  for (unsigned i = 0; i <= n; ++i) {
    for (unsigned k = 0; k < n; ++k) {
      const double polar = std::numbers::pi * i / n, azimuth = 2 * std::numbers::pi * k / n;
      mesh.positions.push_back(radius * dvec3(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                              std::sin(polar) * std::sin(azimuth)));
    }
  }
  for (unsigned i = 0; i < n; ++i) {
    for (unsigned k = 0; k < n; ++k) {
      const unsigned a = i * n + k, b = i * n + (k + 1) % n, c = a + n, d = b + n;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  if (!split) return mesh;
  Mesh corners;
  for (auto t : mesh.triangles) {
    for (std::uint32_t& corner : t) {
      corners.positions.push_back(mesh.positions[corner]);
      corner = static_cast<std::uint32_t>(corners.positions.size()) - 1;
    }
    corners.triangles.push_back(t);
  }
  return corners;
}

Object& add_mesh(Scene& scene, const Mesh& mesh) {
  MeshAsset asset;
  asset.data = std::make_shared<const Mesh>(mesh);
  scene.meshes.push_back(asset);
  Object object;
  object.name = "mesh " + std::to_string(scene.meshes.size());
  object.shape = MeshShape{static_cast<int>(scene.meshes.size()) - 1};
  object.material = 0;
  return scene.objects.emplace_back(object);
}

Precision precision_of_scene(const Scene& scene) {
  return precision_of(compile(scene, KernelKind::Auto)->kernel);
}

// Small parts of a model that hang on nothing are objects of their own to a camera.
TEST(Precision, TheSmallestPieceOfAMeshIsItsFeature) {
  for (const bool split : {false, true}) {
    Scene scene = spheres({});
    add_mesh(scene, ball_mesh(1, 30, split));
    EXPECT_DOUBLE_EQ(measure_reach(scene).smallest, 2) << "corners alike are one";
    EXPECT_EQ(precision_of_scene(scene), Precision::Float);
    Mesh both = *scene.meshes[0].data;
    const Mesh crumb = ball_mesh(1e-5, 6, split);
    const auto first = static_cast<std::uint32_t>(both.positions.size());
    for (const dvec3& p : crumb.positions) both.positions.push_back(p + dvec3(3, 0, 0));
    for (auto t : crumb.triangles) {
      for (std::uint32_t& corner : t) corner += first;
      both.triangles.push_back(t);
    }
    Scene with_crumb = spheres({});
    add_mesh(with_crumb, both).transform.scale = dvec3(1, 0.5, 1);
    EXPECT_NEAR(measure_reach(with_crumb).smallest, 1e-5, 1e-14);
    EXPECT_EQ(precision_of_scene(with_crumb), Precision::Double);
  }
  // A triangle without area, and corners of no triangle.
  Scene point = spheres({});
  add_mesh(point, {{{0, 0, 0}, {5, 0, 0}}, {}, {}, {{0, 0, 0}}});
  EXPECT_EQ(measure_reach(point).smallest, std::numeric_limits<double>::infinity());
}

TEST(Precision, WhatIsKnownOfAMeshIsNotAskedAgain) {
  Scene scene = spheres({});
  add_mesh(scene, ball_mesh(1, 8));
  SceneReach known = measure_reach(scene);
  known.pieces[0].second = 0.125;
  EXPECT_EQ(measure_reach(scene, &known).smallest, 0.125);
  scene.meshes[0].data = std::make_shared<const Mesh>(ball_mesh(1, 8));
  EXPECT_DOUBLE_EQ(measure_reach(scene, &known).smallest, 2);
}

TEST(Precision, GapsBetweenMeshesAskForDouble) {
  const auto balls = [](double scale, unsigned n, const Mesh* second = nullptr) {
    Scene scene = spheres({});
    add_mesh(scene, ball_mesh(1, n));
    Object copy = scene.objects[0];
    copy.transform.scale = dvec3(scale);
    copy.transform.translation = {0, scale - 1, 0};
    if (second != nullptr) copy.shape = add_mesh(scene, *second).shape;
    scene.objects.resize(1);
    scene.objects.push_back(copy);
    return scene;
  };
  for (const unsigned n : {10U, 60U}) {  // few triangles, and more than are looked at one by one
    EXPECT_EQ(precision_of_scene(balls(1 + 1e-7, n)), Precision::Double) << n;
    EXPECT_NEAR(measure_reach(balls(1 + 1e-7, n)).gap, 2e-7, n < 20 ? 2e-7 : 1e-9) << n;
    EXPECT_EQ(precision_of_scene(balls(1, n)), Precision::Float) << n;
    EXPECT_EQ(precision_of_scene(balls(1.001, n)), Precision::Float) << n;
    const Mesh moved = ball_mesh(1 + 1e-8, n), other = ball_mesh(1 + 1e-8, n + 1);
    EXPECT_EQ(precision_of_scene(balls(1, n, &moved)), Precision::Double) << n;
    EXPECT_EQ(precision_of_scene(balls(1, n, &other)), Precision::Float) << n;
  }
  const auto crate_and = [](const Shape& shape) {
    Scene scene = spheres({});
    Mesh crate;
    for (unsigned i = 0; i < 8; ++i) {
      crate.positions.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                                   (i & 4U) != 0 ? 1 : -1);
    }
    crate.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                       {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    add_mesh(scene, crate);
    Object object;
    object.shape = shape;
    object.material = 0;
    scene.objects.push_back(object);
    return precision_of_scene(scene);
  };
  const auto plate = [](double y) {
    return RectangleShape{.corner = {-0.5, y, 0.3}, .edge_u = {0.9, 0, 0}, .edge_v = {0, 0, -0.8}};
  };
  EXPECT_EQ(crate_and(plate(1 + 1e-8)), Precision::Double);
  EXPECT_EQ(crate_and(plate(-1 - 1e-8)), Precision::Double);
  EXPECT_EQ(crate_and(plate(1)), Precision::Float);
  EXPECT_EQ(crate_and(plate(1.01)), Precision::Float);
  // A sheet of many small triangles.
  for (const unsigned n : {30U, 33U}) {
    Mesh sheet;
    for (unsigned i = 0; i <= n; ++i) {
      for (unsigned k = 0; k <= n; ++k)
        sheet.positions.emplace_back(2.0 * i / n - 1, 1, 2.0 * k / n - 1);
    }
    for (unsigned i = 0; i < n; ++i) {
      for (unsigned k = 0; k < n; ++k) {
        const unsigned a = i * (n + 1) + k, b = a + n + 1;
        sheet.triangles.push_back({a, a + 1, b + 1});
        sheet.triangles.push_back({a, b + 1, b});
      }
    }
    Scene scene = spheres({});
    add_mesh(scene, sheet);
    Object object;
    object.shape = plate(1 + 1e-7);
    object.material = 0;
    scene.objects.push_back(object);
    // 2 n^2 are too many to be looked at from n = 33 on.
    EXPECT_EQ(precision_of_scene(scene), n < 32 ? Precision::Double : Precision::Float) << n;
  }
}

// The outer of two copies is in front, whichever float would find.
TEST(Precision, TheOuterOfTwoCopiesIsInFront) {
  Scene scene = spheres({});
  add_mesh(scene, ball_mesh(1, 60));
  Object lacquer = scene.objects[0];
  lacquer.transform.scale = dvec3(1 + 1e-7);
  scene.objects.push_back(lacquer);
  const auto wrong = [&](KernelKind kernel) {
    const auto compiled = compile(scene, kernel);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int count = 0;
    for (int k = 0; k < 20000; ++k) {
      Ray ray;
      ray.origin = 5.0 * glm::normalize(dvec3(uniform(random), uniform(random), uniform(random)));
      ray.direction = 0.5 * dvec3(uniform(random), uniform(random), uniform(random)) - ray.origin;
      const auto hit = trace(*compiled, ray);
      count += hit && hit->object != 1 ? 1 : 0;
    }
    return count;
  };
  EXPECT_EQ(wrong(KernelKind::Auto), 0);
  EXPECT_GT(wrong(best_kernel(Precision::Float)), 1000) << "float could do it";
}

// From afar float loses wider gaps.
TEST(Precision, AnEyeFarFromAGapAsksForDouble) {
  Scene scene = spheres({{.radius = 1}, {.radius = 1.00004}});
  const auto near = compile(scene, KernelKind::Auto);
  EXPECT_EQ(near->kernel, best_kernel(Precision::Float));
  scene.camera.look_from = {0, 0, 1000};
  const auto far = compile(scene, KernelKind::Auto, near.get(), Change::Camera);
  EXPECT_EQ(far->kernel, best_kernel(Precision::Double));
  EXPECT_NE(far->stats.precision_reason.find("r1.000000 and r1.000040"), std::string::npos)
      << far->stats.precision_reason;
}

// What coincides is rounded apart by as much as a double holds far from 0.
TEST(Precision, MovingASceneAsksForNothing) {
  for (const double away : {0.0, 1e5, 1e7}) {
    Scene scene = spheres({});
    scene.camera.look_from = dvec3(away, away, away + 5);
    scene.camera.look_at = dvec3(away);
    const auto put = [&](const Shape& shape, double degrees) {
      Object object;
      object.shape = shape;
      object.material = 0;
      object.transform.translation = dvec3(away);
      object.transform.axis = {0, 1, 0};
      object.transform.degrees = degrees;
      scene.objects.push_back(object);
    };
    put(RectangleShape{.corner = {-3, 0, 3}, .edge_u = {6, 0, 0}, .edge_v = {0, 0, -6}}, 0);
    for (int i = 0; i < 8; ++i) {
      put(BoxShape{.min = {-0.3, 0, -0.3}, .max = {0.7, 0.1 + i, 0.4}}, 11.0 * i);
    }
    EXPECT_EQ(compile(scene, KernelKind::Auto)->kernel, best_kernel(Precision::Float)) << away;
  }
}

// Many objects alike do not cost the square of their number.
TEST(Precision, GapsAreFoundAmongManyObjects) {
  Scene scene = spheres({});
  for (int i = 0; i < 150; ++i) {
    for (int k = 0; k < 150; ++k) {
      Object object;
      object.material = 0;
      const dvec3 foot(3.0 * i, 0, 3.0 * k);
      if ((i + k) % 2 == 0) {
        object.shape = CylinderShape{.p0 = foot, .p1 = foot + dvec3(0, 2, 0), .radius = 0.5};
      } else {
        object.shape = SphereShape{.center = foot, .radius = 0.5};
      }
      scene.objects.push_back(object);
    }
  }
  EXPECT_EQ(measure_reach(scene).gap, std::numeric_limits<double>::infinity());
  Object shell = scene.objects[12345];
  std::visit(
      [](auto& shape) {
        if constexpr (requires { shape.radius; }) shape.radius += 1e-6;
      },
      shell.shape);
  scene.objects.push_back(shell);
  EXPECT_NEAR(measure_reach(scene).gap, 1e-6, 1e-12);
}

// Float at the largest range it is chosen for, against the exact answer for the very ray it traces.
TEST(Precision, FloatFindsTheOutlineOfASphereAtItsLargestRange) {
  Scene scene = spheres({{.radius = 1}});
  scene.camera.look_from = {0, 0, 0.99 * kFloatRange};
  const auto compiled = compile(scene, KernelKind::Auto);
  ASSERT_EQ(compiled->kernel, best_kernel(Precision::Float));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int wrong = 0, hits = 0;
  constexpr int kRays = 100000;
  for (int k = 0; k < kRays; ++k) {
    const dvec3 toward = glm::normalize(dvec3(uniform(random), uniform(random), uniform(random)));
    const dvec3 side = glm::normalize(glm::cross(toward, dvec3(0.3, 0.5, 0.8)));
    // Float numbers, so that the kernel's ray is this ray; near the outline, where it matters.
    const dvec3 origin =
        glm::vec3(-scene.camera.look_from.z * toward + (1 + 0.01 * uniform(random)) * side);
    Ray ray;
    ray.origin = origin;
    ray.direction = toward;
    const dvec3 d = glm::vec3(glm::normalize(toward));
    const long double dd = glm::dot(d, d);
    long double b = 0, off = 0;
    for (int i = 0; i < 3; ++i) b -= static_cast<long double>(origin[i]) * d[i] / dd;
    for (int i = 0; i < 3; ++i) {
      const long double l = origin[i] + b * d[i];
      off += l * l;
    }
    const bool hit = trace(*compiled, ray).has_value();
    wrong += hit != (off < 1) ? 1 : 0;
    hits += hit ? 1 : 0;
  }
  EXPECT_GT(hits, kRays / 4);
  EXPECT_LE(wrong, 2) << "of " << kRays << " within 1 % of the outline";
}

}  // namespace
}  // namespace lightbench
