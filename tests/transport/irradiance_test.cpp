// Light that falls on a point from one light of every shape: closed forms and quadratures. The
// receiver is a lambertian rectangle seen along one ray, so its radiance is albedo / pi times the
// irradiance at one point.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/proof/build_scene.h"
#include "app/proof/closed_forms.h"
#include "tests/transport/measure.h"
#include "tests/transport/shape_patches.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec2;
using glm::dvec3;
constexpr double kPi = std::numbers::pi;
constexpr double kAlbedo = 0.5;

/// The lit point is the origin, the surface normal +y; seen from below the lights.
Scene receiver_scene() {
  Scene s = dark_scene();
  add(s, RectangleShape{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, lambertian(dvec3(kAlbedo)));
  aim(s, {-4, 0.5, 3}, dvec3(0));
  return s;
}

class Irradiance : public testing::TestWithParam<KernelUnderTest> {
 protected:
  Irradiance() : family(GetParam().family()) {}
  void check(const std::string& name, double irradiance, const Scene& scene, int spp = 256) {
    family.add(name, kAlbedo / kPi * irradiance,
               measure_uniform(scene, GetParam().kind, GetParam().spp(spp)));
  }
  Family family;
};

TEST_P(Irradiance, FromSpheres) {
  const auto sphere_at = [](const dvec3& center, double radius, const dvec3& motion = dvec3(0)) {
    Scene s = receiver_scene();
    add(s, SphereShape{center, radius, motion}, light(dvec3(1)));
    return s;
  };
  const auto form = [](const dvec3& c, double r) {
    const double d2 = glm::dot(c, c);
    return kPi * r * r / d2 * c.y / std::sqrt(d2);
  };
  for (const auto& [center, radius] : {std::pair{dvec3(0, 2, 0), 0.5},
                                       {dvec3(1.5, 2, -1), 0.5},
                                       {dvec3(0, 3, 0), 2.9},
                                       {dvec3(2, 3, 1), 0.05},
                                       {dvec3(2, 0.5, 1), 0.49}}) {
    check("sphere of " + std::to_string(radius), form(center, radius), sphere_at(center, radius));
  }
  const SphereShape low{{1.5, 0.1, -1}, 0.6, {0, 0, 0}};
  check("sphere through the horizon", patch_irradiance({}, {sphere_patch(low, {})}),
        sphere_at(low.center, low.radius));
  const dvec3 motion(-3, 1, 2);
  check("moving sphere",
        integrate(0, 1, 1000, [&](double t) { return form(dvec3(1.5, 2, -1) + t * motion, 0.5); }),
        sphere_at({1.5, 2, -1}, 0.5, motion));
  family.expect_agreement();
}

TEST_P(Irradiance, FromEllipsoids) {
  const SphereShape unit{{0.1, 0, 0}, 0.5, {0, 0, 0}};
  for (const double height : {2.0, 0.4}) {
    Transform t = turned({1, 2, -1}, 40, {0.8, height, -1});
    t.scale = {1.8, 0.6, 1.1};
    Scene s = receiver_scene();
    add(s, unit, light(dvec3(1)), t);
    check("ellipsoid at height " + std::to_string(height),
          patch_irradiance({}, {sphere_patch(unit, t)}), s, 512);
  }
  family.expect_agreement();
}

TEST_P(Irradiance, FromDiscs) {
  for (const double h : {0.05, 0.5, 2.0, 50.0}) {
    Scene s = receiver_scene();
    add(s, DiscShape{{0, h, 0}, {0, -2, 0}, 0.75}, light(dvec3(1)));
    // The ray that looks must pass beside or below the light.
    if (h < 0.5) aim(s, {-4, 0.1, 3}, dvec3(0));
    check("disc on the axis at " + std::to_string(h), kPi * 0.75 * 0.75 / (0.75 * 0.75 + h * h), s,
          512);
  }
  const DiscShape tilted{{1, 1.5, -0.5}, {-1, -1, 0.3}, 0.8};
  const DiscShape low{{1.5, 0.2, -0.5}, {-1, 0.1, 0.3}, 0.8};
  Transform stretched = turned({1, 2, -1}, 25, {0.2, 0.5, 0.1});
  stretched.scale = {1.5, 0.8, 0.6};
  for (const Transform& t : {Transform{}, stretched}) {
    for (const DiscShape& d : {tilted, low}) {
      Scene s = receiver_scene();
      add(s, d, light(dvec3(1)), t);
      check("tilted disc", patch_irradiance({}, {disc_patch(d.center, d.normal, d.radius, t)}), s,
            512);
    }
  }
  family.expect_agreement();
}

TEST_P(Irradiance, FromRectanglesAndTriangles) {
  struct Case {
    const char* name;
    dvec3 corner, u, v;
  };
  const Case cases[] = {{"above", {-0.5, 1, -0.5}, {1, 0, 0}, {0, 0, 1}},
                        {"nearly touching", {-0.5, 0.02, -0.5}, {1, 0, 0}, {0, 0, 1}},
                        {"far and small", {3, 4, -2}, {0.05, 0, 0}, {0, 0, 0.05}},
                        {"sheared", {0.3, 1, -0.5}, {1, 0.2, 0.4}, {0.3, 0, 1}},
                        {"through the horizon", {1, -0.5, -1}, {0, 0, 2}, {0, 1.2, 0}},
                        {"standing on the receiver", {1, 0, -1}, {0, 0, 2}, {0, 1.2, 0}}};
  for (const Case& c : cases) {
    const std::vector<dvec3> corners = {c.corner, c.corner + c.u, c.corner + c.u + c.v,
                                        c.corner + c.v};
    Scene s = receiver_scene();
    if (c.corner.y < 0.1 && c.corner.y > 0) aim(s, {-4, 0.05, 3}, dvec3(0));
    Scene as_triangle = s;
    add(s, RectangleShape{c.corner, c.u, c.v}, light(dvec3(1)));
    check(std::string("rectangle ") + c.name, polygon_irradiance({}, corners), s);
    add(as_triangle, TriangleShape{corners[0], corners[1], corners[3]}, light(dvec3(1)));
    check(std::string("triangle ") + c.name,
          polygon_irradiance({}, {corners[0], corners[1], corners[3]}), as_triangle);
  }
  family.expect_agreement();
}

TEST_P(Irradiance, FromSolids) {
  const BoxShape box{{-0.4, -0.3, -0.5}, {0.4, 0.3, 0.5}};
  const PyramidShape pyramid{
      {dvec3{0, 0.7, 0}, dvec3{-0.6, -0.3, -0.4}, dvec3{0.6, -0.3, -0.5}, dvec3{0.1, -0.4, 0.7}}};
  const CylinderShape cylinder{{-0.3, -0.5, 0.1}, {0.3, 0.5, -0.1}, 0.4};
  const Mesh mesh = octahedron(0.7);
  Transform plain = turned({1, 2, -1}, 35, {0.8, 1.6, -0.7});
  Transform stretched = plain, low = plain, mirrored = plain;
  stretched.scale = {1.3, 0.6, 0.9};
  mirrored.scale = {-1.3, 0.6, 0.9};
  low.translation.y = 0.25;
  const std::pair<const char*, Transform> places[] = {
      {"", plain}, {" stretched", stretched}, {" mirrored", mirrored}, {" in the floor", low}};
  for (const auto& [where, t] : places) {
    const auto scene_with = [&, &t = t](const Shape& shape) {
      Scene s = receiver_scene();
      add(s, shape, light(dvec3(1)), t);
      return s;
    };
    // A box under a stretched map stays a box only while its axes are kept; its own are.
    check(std::string("box") + where,
          polyhedron_irradiance({},
                                [&, &t = t] {
                                  auto faces = box_faces(box, t);
                                  if (t.scale.x < 0) {
                                    for (auto& f : faces) std::swap(f[1], f[3]);
                                  }
                                  return faces;
                                }()),
          scene_with(box), 512);
    check(std::string("pyramid") + where, polyhedron_irradiance({}, pyramid_faces(pyramid, t)),
          scene_with(pyramid), 512);
    std::vector<EmittingPatch> patches = cylinder_patches(cylinder, t);
    for (EmittingPatch& p : patches) p.flipped = t.scale.x < 0;
    check(std::string("cylinder") + where, patch_irradiance({}, patches), scene_with(cylinder),
          512);
    std::vector<std::vector<dvec3>> triangles;
    for (const auto& i : mesh.triangles) {
      triangles.push_back(
          place_all(t, {mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]}));
      if (t.scale.x < 0) std::swap(triangles.back()[1], triangles.back()[2]);
    }
    Scene s = receiver_scene();
    add(s, MeshShape{add_mesh(s, mesh)}, light(dvec3(1)), t);
    // Light sampling does not know which triangles face away or lie below the floor.
    check(std::string("mesh") + where, polyhedron_irradiance({}, triangles), s, 2048);
  }
  family.expect_agreement();
}

TEST_P(Irradiance, OneSidedLightsAreDarkBehind) {
  const Shape flat[] = {RectangleShape{{-0.5, 1, -0.5}, {0, 0, 1}, {1, 0, 0}},
                        DiscShape{{0, 1, 0}, {0, 1, 0}, 0.6},
                        TriangleShape{{0, 1, 0}, {0, 1, 1}, {1, 1, 0}}};
  const double both_sides[] = {
      polygon_irradiance({}, {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}}),
      kPi * 0.36 / 1.36, polygon_irradiance({}, {{0, 1, 0}, {0, 1, 1}, {1, 1, 0}})};
  for (std::size_t i = 0; i < 3; ++i) {
    Scene back = receiver_scene(), both = receiver_scene();
    add(back, flat[i], light(dvec3(1), false));
    add(both, flat[i], light(dvec3(1), true));
    EXPECT_EQ(measure_uniform(back, GetParam().kind, 8).mean.y, 0);
    check("two-sided light from behind", both_sides[i], both);
  }
  // Closed lights emit outwards; from within they are dark unless they have two sides.
  Scene shapes;
  for (const PlacedShape& placed : closed_shapes(shapes)) {
    for (const bool two_sided : {false, true}) {
      Scene s = dark_scene();
      s.meshes = shapes.meshes;
      add(s, DiscShape{{0, 0, 0}, {0, 1, 0}, 0.05}, lambertian(dvec3(kAlbedo)));
      add(s, placed.shape, light(dvec3(1), two_sided), placed.transform);
      aim(s, {0.1, 0.15, 0.1}, dvec3(0));
      if (two_sided) {
        check(std::string("within a ") + placed.name, kPi, s, 512);
      } else {
        EXPECT_EQ(measure_uniform(s, GetParam().kind, 8).mean.y, 0) << placed.name;
      }
    }
  }
  family.expect_agreement();
}

TEST_P(Irradiance, FromTexturedLights) {
  Texture checker;
  checker.kind = TextureKind::Checker;
  checker.color_a = dvec3(1);
  checker.color_b = dvec3(0.2);
  checker.scale = 2;
  const auto checker_at = [](const dvec3& p) {
    const int parity =
        static_cast<int>(std::floor(2 * p.x) + std::floor(2 * p.y) + std::floor(2 * p.z));
    return (parity & 1) != 0 ? 0.2 : 1.0;
  };
  const auto scene_with = [&](const Shape& shape, bool in_uv, const Transform& t = {}) {
    Scene s = receiver_scene();
    checker.use_uv = in_uv;
    Material m = light(dvec3(3));
    m.emissive_texture = add_texture(s, checker);
    add(s, shape, m, t);
    return s;
  };
  const RectangleShape rectangle{{-0.2, 0.9, -0.7}, {1.3, 0, 0.2}, {0, 0.4, 1}};
  const auto point = [&](dvec2 u) {
    return rectangle.corner + u.x * rectangle.edge_u + u.y * rectangle.edge_v;
  };
  double sum = 0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double a = 0.5 * i, b = 0.5 * j;
      sum += ((i + j) % 2 != 0 ? 0.2 : 1.0) *
             polygon_irradiance({}, {point({a, b}), point({a + 0.5, b}), point({a + 0.5, b + 0.5}),
                                     point({a, b + 0.5})});
    }
  }
  check("rectangle, uv", 3 * sum, scene_with(rectangle, true));
  // Barycentric cells of the triangle below the diagonal: a corner square and two triangles.
  sum =
      polygon_irradiance({}, {point({0, 0}), point({0.5, 0}), point({0.5, 0.5}), point({0, 0.5})}) +
      0.2 * (polygon_irradiance({}, {point({0.5, 0}), point({1, 0}), point({0.5, 0.5})}) +
             polygon_irradiance({}, {point({0, 0.5}), point({0.5, 0.5}), point({0, 1})}));
  check("triangle, uv", 3 * sum,
        scene_with(TriangleShape{point({0, 0}), point({1, 0}), point({0, 1})}, true));
  EmittingPatch patch{point, [&](dvec2 u) { return 3 * checker_at(point(u)); }};
  check("rectangle, solid", patch_irradiance({}, {patch}, 2000), scene_with(rectangle, false), 512);

  // Solid textures live in object space: the sphere's move with it.
  Transform t = turned({1, 2, -1}, 40, {0.6, 2, -0.4});
  const SphereShape ball{{0.1, 0.2, 0}, 0.8, {0, 0, 0}};
  patch = sphere_patch(ball, t);
  const EmittingPatch local = sphere_patch(ball, {});
  patch.radiance = [&](dvec2 u) { return 3 * checker_at(local.point(u)); };
  check("sphere, solid", patch_irradiance({}, {patch}, 2000), scene_with(ball, false, t), 512);

  Scene s = receiver_scene();
  Material m = light(dvec3(3));
  checker.use_uv = true;
  m.emissive_texture = add_texture(s, checker);
  Mesh mesh;
  mesh.positions = {point({0, 0}), point({1, 0}), point({1, 1}), point({0, 1})};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  add(s, MeshShape{add_mesh(s, mesh)}, m);
  sum = 0;
  for (int i = 0; i < 4; ++i) {
    const double a = 0.5 * (i & 1), b = 0.5 * (i >> 1);
    sum += (i == 1 || i == 2 ? 0.2 : 1.0) *
           polygon_irradiance({}, {point({a, b}), point({a + 0.5, b}), point({a + 0.5, b + 0.5}),
                                   point({a, b + 0.5})});
  }
  check("mesh, uv", 3 * sum, s);
  family.expect_agreement();
}

TEST_P(Irradiance, OfManyLightsAddsUp) {
  Scene s = receiver_scene();
  double sum = 0;
  // In rows of directions that keep clear of each other, of very unequal power and distance.
  for (int i = 0; i < 48; ++i) {
    const int row = i / 12;
    const double angle = 2 * kPi * (i % 12) / 12, height = 0.35 + 0.3 * row;
    const double power = i % 7 == 0 ? 20 : 0.5, distance = 1 + 0.13 * ((i * 5) % 17);
    const dvec3 c = distance * dvec3(std::cos(height) * std::cos(angle), std::sin(height),
                                     std::cos(height) * std::sin(angle));
    const double radius = 0.04 * distance;
    add(s, SphereShape{c, radius, {0, 0, 0}}, light(dvec3(power)));
    sum += power * kPi * 0.04 * 0.04 * std::sin(height);
  }
  aim(s, dvec3(-1.5, 0.1, 1.1), dvec3(0));
  check("48 spheres", sum, s, 512);
  family.expect_agreement();
}

// Glossy reflection of a light needs both strategies: the lobe alone hits a small light seldom, the
// light alone meets a narrow lobe seldom. Quadrature over the cone that the light fills.
TEST_P(Irradiance, OnGlossyMetalIsTheLobeOverTheLight) {
  for (const double roughness : {0.1, 0.3, 0.7}) {
    for (const double radius : {0.05, 0.8}) {
      const double alpha = roughness * roughness;
      const dvec3 wo = glm::normalize(dvec3(-1, 1.2, 0)), axis = glm::normalize(dvec3(1, 1.1, 0.1));
      const double distance = 2, cosine = std::sqrt(1 - radius * radius / (distance * distance));
      Scene s = dark_scene();
      add(s, RectangleShape{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, rough_metal(dvec3(0.9), roughness));
      add(s, SphereShape{distance * axis, radius, {0, 0, 0}}, light(dvec3(1)));
      aim(s, 5.0 * wo, dvec3(0));
      const auto lambda = [&](double z) {
        return (std::sqrt(1 + alpha * alpha * (1 - z * z) / (z * z)) - 1) / 2;
      };
      const dvec3 a = glm::normalize(glm::cross(axis, dvec3(0, 1, 0))), b = glm::cross(axis, a);
      const int n = 1500;
      double sum = 0;
      for (int i = 0; i < n; ++i) {
        const double z = 1 - (1 - cosine) * (i + 0.5) / n, r = std::sqrt(1 - z * z);
        for (int j = 0; j < n; ++j) {
          const double phi = 2 * kPi * (j + 0.5) / n;
          const dvec3 wi = z * axis + r * (std::cos(phi) * a + std::sin(phi) * b);
          if (wi.y <= 0) continue;
          const dvec3 h = glm::normalize(wi + wo);
          const double k = (h.x * h.x + h.z * h.z) / (alpha * alpha) + h.y * h.y;
          const double d = 1 / (kPi * alpha * alpha * k * k);
          sum += 0.9 * d / (4 * wo.y * (1 + lambda(wo.y) + lambda(wi.y)));
        }
      }
      family.add("roughness " + std::to_string(roughness) + " light " + std::to_string(radius),
                 sum * 2 * kPi * (1 - cosine) / n / n,
                 measure_uniform(s, GetParam().kind, GetParam().spp(512)));
    }
  }
  family.expect_agreement();
}

INSTANTIATE_TEST_SUITE_P(Kernels, Irradiance, testing::Values(kFastKernel, kReferenceKernel),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace lightbench
