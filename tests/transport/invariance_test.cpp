// The same world written in other words: other units, another place, transforms instead of
// coordinates. The same seed must give the same picture but for rounding.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/mat4x4.hpp>
#include <string>

#include "app/proof/build_scene.h"
#include "app/proof/same_world.h"
#include "core/scene/scene_io.h"
#include "core/scene/transform.h"
#include "tests/transport/measure.h"

namespace lightbench {
using namespace proof;
namespace {

using glm::dvec3;

constexpr int kSize = 64;

std::vector<std::pair<std::string, Scene>> scenes() {
  std::vector<std::pair<std::string, Scene>> all;
  // Those of the books are chaotic: paths meet many small balls, and a change of the last bit
  // sends one in a thousand elsewhere.
  for (const char* name :
       {"cornell-plain", "features/instances", "features/media", "features/shape-lights",
        "features/depth-of-field", "bouncing-spheres", "perlin-spheres", "next-week-final"}) {
    all.emplace_back(name,
                     load_scene(std::string(LIGHTBENCH_SOURCE_DIR "/scenes/") + name + ".json"));
    all.back().second.render.width = all.back().second.render.height = kSize;
  }
  return all;
}

TEST(Invariance, UnitsAndPlaceDoNotShow) {
  struct Case {
    const char* name;
    double scale;
    double shift;
    double largest_mae;
  };
  // In other units float is given the same numbers but for the rounding of double, which reaches
  // the last bit of a number in a million.
  const Case cases[] = {{"units 2^-13", 0x1p-13, 0, 0},
                        {"units 1e-4", 1e-4, 0, 1e-5},
                        {"units 1e4", 1e4, 0, 1e-5},
                        {"moved by 1e5", 1, 1e5, 1e-5}};
  const int spp = 32;
  for (const auto& [name, scene] : scenes()) {
    const Film plain = render_film(scene, KernelKind::Auto, spp);
    for (const Case& c : cases) {
      const Film other =
          render_film(in_other_units(scene, c.scale, dvec3(c.shift, -c.shift, 0.5 * c.shift)),
                      KernelKind::Auto, spp);
      const PictureDifference d = picture_difference(plain, other, spp);
      fmt::print("{:<24} {:<14} mean ratio - 1 = {:+.2e}  relMAE {:.2e}\n", name, c.name,
                 d.mean_ratio - 1, d.relative_mae);
      EXPECT_LE(d.relative_mae, c.largest_mae) << name << " " << c.name;
      EXPECT_NEAR(d.mean_ratio, 1, 1e-5) << name << " " << c.name;
    }
  }
}

// With seeds of its own on each side: no difference beyond chance.
TEST(Invariance, MeansAgreeBeyondChance) {
  Family family(0.01 * kCoarsening, 0);
  constexpr int kSeeds = kThinning > 1 ? 8 : 32;
  for (const auto& [name, scene] : scenes()) {
    const Estimate plain = measure_by_seeds(scene, KernelKind::Auto, 8, kSeeds);
    Scene other = in_other_units(scene, 1e4, dvec3(1e5, 0, -1e5));
    std::vector<dvec3> means;
    for (int seed = 0; seed < kSeeds; ++seed) {
      other.render.seed = static_cast<std::uint32_t>(5000 + seed);
      const Film film = render_film(other, KernelKind::Auto, 8);
      dvec3 sum(0);
      for (std::size_t i = 0; i < film.pixels().size(); ++i) sum += pixel_mean(film, i, 8);
      means.push_back(sum / static_cast<double>(film.pixels().size()));
    }
    Estimate e = summarize(means);
    for (int k = 0; k < 3; ++k) e.error[k] = std::hypot(e.error[k], plain.error[k]);
    e.freedom *= 2;
    family.add(name, plain.mean, e);
  }
  family.expect_agreement();
}

/// A room with one placed shape, lit from the side.
Scene room_with(const Scene& assets, const Shape& shape, const Transform& t) {
  Scene s = dark_scene(kSize);
  s.meshes = assets.meshes;
  s.render.max_depth = 6;
  add(s, BoxShape{{-3, -2, -3}, {3, 4, 3}}, lambertian(dvec3(0.6)));
  add(s, SphereShape{{1.8, 2.6, 1}, 0.6, {0, 0, 0}}, light(dvec3(5)));
  add(s, shape, lambertian({0.8, 0.5, 0.2}), t);
  look(s, {0, 1, 2.9}, {0, 0, 0}, 50);
  return s;
}

dvec3 place(const Transform& t, const dvec3& p) {
  return dvec3(object_to_world(t) * glm::dvec4(p, 1));
}

TEST(Invariance, TransformsEqualCoordinates) {
  Transform t = turned({1, 2, -1}, 40, {0.3, 0.2, -0.4});
  t.scale = dvec3(0.8);
  const SphereShape sphere{{0.4, 0.1, 0}, 0.9, {0, 0, 0}};
  const CylinderShape cylinder{{-0.3, -0.8, 0.1}, {0.5, 0.8, -0.1}, 0.6};
  const DiscShape disc{{0, 0, 0}, {0.3, 1, 0.9}, 1};
  const RectangleShape rectangle{{-1, -0.4, 0}, {2, 0, 0.4}, {0, 1.2, 0}};
  const TriangleShape triangle{{-1, -0.4, 0}, {1, -0.4, 0.4}, {0, 1.2, 0}};
  const PyramidShape pyramid{
      {dvec3{0, 1, 0}, dvec3{-1, -0.6, -0.8}, dvec3{1, -0.6, -0.9}, dvec3{0.1, -0.7, 1}}};
  const Mesh mesh = octahedron(1.2);
  PyramidShape placed_pyramid;
  for (std::size_t i = 0; i < 4; ++i) placed_pyramid.vertices[i] = place(t, pyramid.vertices[i]);
  Mesh placed_mesh = mesh;
  for (dvec3& p : placed_mesh.positions) p = place(t, p);
  const auto direction = [&](const dvec3& v) { return place(t, v) - place(t, dvec3(0)); };
  Scene assets;
  const MeshShape in_object{add_mesh(assets, mesh)}, in_world{add_mesh(assets, placed_mesh)};
  const std::tuple<const char*, Shape, Shape> pairs[] = {
      {"sphere", sphere, SphereShape{place(t, sphere.center), 0.8 * 0.9, {0, 0, 0}}},
      {"cylinder", cylinder,
       CylinderShape{place(t, cylinder.p0), place(t, cylinder.p1), 0.8 * 0.6}},
      {"disc", disc, DiscShape{place(t, disc.center), direction(disc.normal), 0.8}},
      {"rectangle", rectangle,
       RectangleShape{place(t, rectangle.corner), direction(rectangle.edge_u),
                      direction(rectangle.edge_v)}},
      {"triangle", triangle,
       TriangleShape{place(t, triangle.a), place(t, triangle.b), place(t, triangle.c)}},
      {"pyramid", pyramid, placed_pyramid},
      {"mesh", in_object, in_world}};
  const int spp = 32;
  for (const auto& [name, object_space, world_space] : pairs) {
    const Film a = render_film(room_with(assets, object_space, t), KernelKind::Auto, spp);
    const Film b = render_film(room_with(assets, world_space, {}), KernelKind::Auto, spp);
    const PictureDifference d = picture_difference(a, b, spp);
    fmt::print("{:<12} mean ratio - 1 = {:+.2e}  relMAE {:.2e}\n", name, d.mean_ratio - 1,
               d.relative_mae);
    EXPECT_LT(d.relative_mae, 1e-4) << name;
    EXPECT_NEAR(d.mean_ratio, 1, 1e-5) << name;
  }
}

TEST(Invariance, NestedScalesCancel) {
  Scene assets;
  for (const PlacedShape& placed : closed_shapes(assets)) {
    // Twice the shape at half the scale; for a mesh, the vertices.
    Transform half = placed.transform;
    half.scale *= 0.5;
    Scene other = assets;
    Shape twice = placed.shape;
    if (auto* s = std::get_if<SphereShape>(&twice)) s->radius *= 2;
    if (auto* s = std::get_if<BoxShape>(&twice)) *s = {2.0 * s->min, 2.0 * s->max};
    if (auto* s = std::get_if<CylinderShape>(&twice))
      *s = {2.0 * s->p0, 2.0 * s->p1, 2 * s->radius};
    if (auto* s = std::get_if<PyramidShape>(&twice)) {
      for (dvec3& v : s->vertices) v *= 2;
    }
    if (std::holds_alternative<MeshShape>(twice))
      twice = MeshShape{add_mesh(other, octahedron(2.4))};
    const int spp = 32;
    const Film a =
        render_film(room_with(assets, placed.shape, placed.transform), KernelKind::Auto, spp);
    const Film b = render_film(room_with(other, twice, half), KernelKind::Auto, spp);
    const PictureDifference d = picture_difference(a, b, spp);
    fmt::print("{:<18} mean ratio - 1 = {:+.2e}  relMAE {:.2e}\n", placed.name, d.mean_ratio - 1,
               d.relative_mae);
    EXPECT_LT(d.relative_mae, 1e-4) << placed.name;
    EXPECT_NEAR(d.mean_ratio, 1, 1e-5) << placed.name;
  }
}

// A box as a box, as twelve triangles of a mesh and as six rectangles: other code and other random
// numbers, so agreement within chance.
TEST(Invariance, ABoxIsItsMeshAndItsRectangles) {
  const BoxShape box{{-0.8, -0.5, -0.7}, {0.8, 0.5, 0.7}};
  const Transform t = turned({1, 2, -1}, 40, {0.3, 0.2, -0.4});
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                i & 4 ? box.max.z : box.min.z);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  Scene assets;
  const MeshShape as_mesh{add_mesh(assets, mesh)};
  for (const bool glowing : {false, true}) {
    const auto scene_of = [&](const Shape& shape) {
      Scene s = room_with(assets, shape, t);
      if (glowing) s.materials.back().emissive = dvec3(2, 1, 3);
      return s;
    };
    const Estimate as_box = measure_by_seeds(scene_of(box), KernelKind::Auto, 8, 32);
    const auto corner = [&](int i) { return mesh.positions[static_cast<std::size_t>(i)]; };
    Scene rectangles = scene_of(box);
    const Material material = rectangles.materials.back();
    rectangles.objects.pop_back();
    const int faces[6][3] = {{0, 4, 2}, {1, 3, 5}, {0, 1, 4}, {2, 6, 3}, {0, 2, 1}, {4, 5, 6}};
    for (const auto& f : faces) {
      add(rectangles,
          RectangleShape{corner(f[0]), corner(f[1]) - corner(f[0]), corner(f[2]) - corner(f[0])},
          material, t);
    }
    Family family(0.01, 0);
    for (const Scene& other : {scene_of(as_mesh), rectangles}) {
      // The seeds are shared: noise in common makes the stated error too large, not too small.
      Estimate e = measure_by_seeds(other, KernelKind::Auto, 8, 32);
      for (int k = 0; k < 3; ++k) e.error[k] = std::hypot(e.error[k], as_box.error[k]);
      family.add(glowing ? "glowing box" : "box", as_box.mean, e);
    }
    family.expect_agreement();
  }
}

}  // namespace
}  // namespace lightbench
