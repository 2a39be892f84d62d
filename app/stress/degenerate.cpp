// Degenerate input: rejected with a message, or rendered without a bad sample and without a change
// to what is seen beside it.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

#include "app/proof/build_scene.h"
#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"
#include "core/error.h"
#include "core/scene/scene_io.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kDenormal = 1e-310;
constexpr int kSide = 16, kSpp = 4;

/// A lit room corner with one of each kind of surface, in the left half of the picture.
Scene base_scene() {
  Scene scene = empty_scene();
  scene.render.width = scene.render.height = kSide;
  scene.camera.look_from = {0, 0, 5};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.vfov = 60;
  scene.environment.kind = EnvironmentKind::Constant;
  scene.environment.color = dvec3(0.5);
  Material glass, metal, light;
  glass.name = "glass";
  glass.kind = MaterialKind::Dielectric;
  metal.name = "metal";
  metal.kind = MaterialKind::Metal;
  metal.roughness = 0.3;
  light.name = "light";
  light.kind = MaterialKind::Emissive;
  light.emissive = dvec3(4);
  scene.materials.insert(scene.materials.end(), {glass, metal, light});
  add_object(scene, SphereShape{{-1.5, 0.5, 0}, 0.7, dvec3(0)}).material = 1;
  add_object(scene, BoxShape{{-2, -1.5, -1}, {-1, -0.5, 0}}).material = 2;
  add_object(scene, DiscShape{{-1.5, 2, 0}, {0, -1, 0}, 0.5}).material = 3;
  return scene;
}

struct Picture {
  std::vector<FilmPixel> pixels;
  std::uint64_t bad = 0;
};
Picture render_all(const Scene& scene, KernelKind kernel) {
  const auto compiled = compile(scene, kernel);
  Film film(kSide, kSide, compiled->film_unit);
  Counters counters;
  render(*compiled, {0, 0, kSide, kSide, 0, kSpp, 1}, film.view(), counters);
  return {film.pixels(), counters.non_finite};
}

/// Pixels that may show what is added; the base scene is in the left half of the picture.
enum class Covers { RightHalf, All };

/// What is in question besides the base scene.
struct Case {
  std::string name;
  /// Unchanged: the picture is that of the base scene with `good` added, to the bit. Clean: no bad
  /// sample, and what is seen directly beside `covers` is that of the base scene.
  enum class Verdict { Rejected, Unchanged, Clean } verdict;
  std::function<void(Scene&)> spoil;
  Covers covers = Covers::All;
  std::function<void(Scene&)> good = [](Scene&) {};
};
using Verdict = Case::Verdict;

Case shape_case(const std::string& name, Verdict verdict, const Shape& shape) {
  return {name, verdict, [shape](Scene& scene) { add_object(scene, shape); }};
}
Mesh octahedron_at(const dvec3& centre, double radius) {
  Mesh mesh = octahedron(radius);
  for (dvec3& p : mesh.positions) p += centre;
  return mesh;
}
std::function<void(Scene&)> adding(const Mesh& mesh) {
  return [mesh](Scene& scene) { stress::add_mesh(scene, mesh); };
}

void add_rejected(std::vector<Case>& cases) {
  const auto shape = [&](const std::string& name, const Shape& s) {
    cases.push_back(shape_case(name, Verdict::Rejected, s));
  };
  const auto camera = [&](const std::string& name, std::function<void(Camera&)> spoil) {
    cases.push_back({name, Verdict::Rejected, [spoil](Scene& s) { spoil(s.camera); }});
  };
  for (const double r : {0.0, -1.0, kNan, kInf, kDenormal}) {
    shape(fmt::format("sphere of radius {}", r), SphereShape{dvec3(0), r, dvec3(0)});
    shape(fmt::format("cylinder of radius {}", r), CylinderShape{{0, 0, 0}, {0, 1, 0}, r});
    shape(fmt::format("disc of radius {}", r), DiscShape{dvec3(0), {0, 1, 0}, r});
  }
  shape("cylinder with p0 = p1", CylinderShape{{1, 1, 1}, {1, 1, 1}, 0.5});
  shape("disc without a normal", DiscShape{dvec3(0), dvec3(0), 1});
  shape("disc with a denormal normal", DiscShape{dvec3(0), {kDenormal, 0, 0}, 1});
  shape("triangle of no area", TriangleShape{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}});
  shape("triangle with a vertex twice", TriangleShape{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  shape("triangle with a NaN vertex", TriangleShape{{0, 0, 0}, {kNan, 0, 0}, {1, 0, 0}});
  shape("triangle with an infinite vertex", TriangleShape{{0, 0, 0}, {kInf, 0, 0}, {1, 1, 0}});
  shape("rectangle with parallel edges", RectangleShape{dvec3(0), {1, 0, 0}, {2, 0, 0}});
  shape("rectangle with an edge of 0", RectangleShape{dvec3(0), {1, 0, 0}, dvec3(0)});
  shape("flat box", BoxShape{{0, 0, 0}, {1, 0, 1}});
  shape("box inside out", BoxShape{{1, 1, 1}, {0, 0, 0}});
  shape("pyramid in a line", PyramidShape{{dvec3(0), dvec3(1), dvec3(2), dvec3(3)}});
  shape("pyramid in a plane",
        PyramidShape{{dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(1, 1, 0)}});
  shape("sphere that moves by NaN", SphereShape{dvec3(0), 1, {kNan, 0, 0}});
  camera("eye = target", [](Camera& c) { c.look_at = c.look_from; });
  camera("eye at NaN", [](Camera& c) { c.look_from.x = kNan; });
  camera("view along up", [](Camera& c) { c.up = c.look_at - c.look_from; });
  camera("field of view of 0", [](Camera& c) { c.vfov = 0; });
  camera("field of view of 180 degrees", [](Camera& c) { c.vfov = 180; });
  const auto mesh = [&](const std::string& name, const Mesh& m) {
    cases.push_back({name, Verdict::Rejected, adding(m)});
  };
  mesh("mesh with a NaN vertex", {{{0, 0, 0}, {1, 0, 0}, {0, kNan, 0}}, {}, {}, {{0, 1, 2}}});
  mesh("mesh with an infinite vertex", {{{0, 0, 0}, {1, 0, 0}, {0, kInf, 0}}, {}, {}, {{0, 1, 2}}});
  mesh("mesh with an index too large", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 3}}});
  cases.push_back({"scale of 0", Verdict::Rejected, [](Scene& s) {
                     add_object(s, SphereShape{}, {.scale = {1, 0, 1}});
                   }});
}

void add_harmless(std::vector<Case>& cases) {
  const auto unchanged = [&](const std::string& name, std::function<void(Scene&)> spoil) {
    cases.push_back({name, Verdict::Unchanged, std::move(spoil)});
  };
  // Triangles of no area, before and among those of a mesh in view, and alone.
  const auto bad = [&](const std::string& name, const std::array<dvec3, 3>& corners) {
    const Mesh alone{{corners.begin(), corners.end()}, {}, {}, {{0, 1, 2}}};
    unchanged(name + " alone in a mesh", adding(alone));
    const Mesh good = octahedron_at({1.5, 0, 0}, 0.7);
    const auto first = static_cast<std::uint32_t>(good.positions.size());
    Mesh mixed = good;
    mixed.positions.insert(mixed.positions.end(), corners.begin(), corners.end());
    for (const std::size_t at : {0U, 4U, 10U}) {
      mixed.triangles.insert(mixed.triangles.begin() + static_cast<std::ptrdiff_t>(at),
                             {first, first + 1, first + 2});
    }
    cases.push_back(
        {name + " among good ones", Verdict::Unchanged, adding(mixed), Covers::All, adding(good)});
  };
  // Before the octahedron and within its bounds, which the rounding of all of it goes by.
  const dvec3 p{1.7, 0.2, 0.6};
  bad("mesh triangle of one point", {p, p, p});
  bad("mesh triangle with a vertex twice", {p, p, p + dvec3(0, 0.4, 0)});
  bad("mesh triangle of no area", {p, p + dvec3(0, 0.2, 0), p + dvec3(0, 0.4, 0)});
  bad("mesh triangle of no area within the good ones",
      {dvec3(1, 0, 0), dvec3(1.5, 0, 0), dvec3(2, 0, 0)});
  unchanged("denormal emission", [](Scene& s) { s.materials[0].emissive = dvec3(kDenormal); });
  unchanged("object without material or medium", [](Scene& s) {
    add_object(s, BoxShape{{1, -1, -1}, {2, 1, 1}}).material = kNone;
  });
}

void add_clean(std::vector<Case>& cases) {
  const auto clean = [&](const std::string& name, Covers covers,
                         std::function<void(Scene&)> spoil) {
    cases.push_back({name, Verdict::Clean, std::move(spoil), covers});
  };
  clean("coincident faces", Covers::RightHalf, [](Scene& s) {
    for (const int material : {0, 1, 2, 3}) {
      add_object(s, BoxShape{{1, -1, -1}, {2, 0, 0}}).material = material;
      add_object(s, RectangleShape{{1, -1, 0}, {1, 0, 0}, {0, 1, 0}}).material = material;
      add_object(s, SphereShape{{1.5, 1, 0}, 0.5, dvec3(0)}).material = material;
      add_object(s, TriangleShape{{1, -1, 0}, {2, -1, 0}, {1, 0, 0}}).material = material;
    }
  });
  clean("camera inside everything", Covers::All, [](Scene& s) {
    for (const int material : {1, 0, 2}) {
      const double size = 6.0 + material;
      add_object(s, SphereShape{s.camera.look_from, size, dvec3(0)}).material = material;
      add_object(s, BoxShape{s.camera.look_from - size, s.camera.look_from + size}).material =
          material;
      add_object(s, CylinderShape{{0, -size, 5}, {0, size, 5}, size}).material = material;
    }
    s.media.emplace_back();
    s.media.back().name = "fog";
    Object& fog = add_object(s, SphereShape{s.camera.look_from, 20, dvec3(0)});
    fog.material = kNone;
    fog.medium = 0;
  });
  clean("eye on a surface", Covers::All, [](Scene& s) {
    add_object(s, RectangleShape{{-1, -1, 5}, {2, 0, 0}, {0, 2, 0}});
    add_object(s, SphereShape{{0, 0, 4}, 1, dvec3(0)}).material = 1;
    add_object(s, BoxShape{{-1, -1, 5}, {1, 1, 6}}).material = 2;
  });
  clean("eye on a light", Covers::All, [](Scene& s) {
    add_object(s, SphereShape{{0, 0, 4}, 1, dvec3(0)}).material = 3;
    add_object(s, TriangleShape{{-1, -1, 5}, {1, -1, 5}, {0, 1, 5}}).material = 3;
  });
  clean("denormal coordinates", Covers::RightHalf, [](Scene& s) {
    add_object(s, SphereShape{{1.5, kDenormal, -kDenormal}, 0.5, {kDenormal, 0, 0}});
    add_object(s, BoxShape{{1, kDenormal, 0}, {2, 1, kDenormal + 0.5}});
    add_object(s, RectangleShape{{1, -1, 0}, {1, kDenormal, 0}, {kDenormal, 0.5, 0}});
  });
  // The eye is in the surface of the larger one as near as can be told.
  clean("sizes 1e-17 and 1e17", Covers::All, [](Scene& s) {
    add_object(s, SphereShape{{1.5, 0, 0}, 1e-17, dvec3(0)});
    add_object(s, SphereShape{{0, -1e17, 0}, 1e17, dvec3(0)});
  });
  clean("a sliver of 1e-11", Covers::RightHalf, [](Scene& s) {
    add_object(s, TriangleShape{{1, 0, 0}, {2, 0, 0}, {1, 1e-11, 0}}).material = 3;
  });
  clean("index of refraction of 1, 0.01 and 100", Covers::RightHalf, [](Scene& s) {
    for (const double ior : {1.0, 0.01, 100.0}) {
      Material glass = s.materials[1];
      glass.name += fmt::format(" {}", ior);
      glass.ior = ior;
      s.materials.push_back(glass);
      add_object(s, SphereShape{{1.5, std::log10(ior), 0}, 0.4, dvec3(0)}).material =
          static_cast<int>(s.materials.size()) - 1;
    }
  });
  clean("roughness 1e-5", Covers::RightHalf, [](Scene& s) {
    s.materials[2].roughness = 1e-5;
    add_object(s, SphereShape{{1.5, 0, 0}, 1, dvec3(0)}).material = 2;
  });
}

std::vector<Case> all_cases() {
  std::vector<Case> cases;
  add_rejected(cases);
  add_harmless(cases);
  add_clean(cases);
  return cases;
}

bool same(const FilmPixel& a, const FilmPixel& b) {
  return a.r == b.r && a.g == b.g && a.b == b.b && a.luminance_squared == b.luminance_squared;
}

enum DegenerateLine { kRejected, kBadPixels, kNeighbours };

void judge(const Case& c, KernelKind kernel, std::span<Tally> tallies) {
  Scene scene = base_scene();
  c.spoil(scene);
  const auto fail = [&](DegenerateLine line, const std::string& what) {
    tallies[line].fail([&] { return c.name + ": " + what; });
  };
  try {
    validate(scene);
  } catch (const Error& error) {
    tallies[kRejected].trial();
    if (c.verdict != Verdict::Rejected) fail(kRejected, error.what());
    if (std::string(error.what()).find("expected") == std::string::npos) {
      fail(kRejected, fmt::format("the message '{}' does not say what is expected", error.what()));
    }
    return;
  }
  if (c.verdict == Verdict::Rejected) {
    tallies[kRejected].trial();
    fail(kRejected, "accepted");
    return;
  }
  const Picture picture = render_all(scene, kernel);
  tallies[kBadPixels].trial(picture.pixels.size());
  if (picture.bad > 0) fail(kBadPixels, fmt::format("{} samples dropped", picture.bad));
  const bool clean = c.verdict == Verdict::Clean;
  Scene plain = base_scene();
  c.good(plain);
  // One segment from the camera: light, shadows and reflections do not spread.
  if (clean) scene.render.max_depth = plain.render.max_depth = 1;
  const Picture expected = render_all(plain, kernel);
  const Picture seen = clean ? render_all(scene, kernel) : picture;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (clean && (c.covers == Covers::All || x >= kSide / 2)) continue;
      const auto i = static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
      tallies[kNeighbours].trial();
      if (!same(seen.pixels[i], expected.pixels[i])) {
        fail(kNeighbours, fmt::format("pixel {},{} changed", x, y));
      }
    }
  }
}

/// Rays with zero and denormal components and with ends from 1e-30 to 1e30.
void judge_rays(Random& random, KernelKind kernel, Tally& tally) {
  const Kind kind = kKinds[random.below(static_cast<int>(std::size(kKinds)) - 1)];
  const Shape shape = random_shape(random, kind);
  const auto scene = compile_alone(shape, dvec3(0, 0, 9), kernel);
  std::vector<Ray> rays;
  for (int k = 0; k < 32; ++k) {
    const dvec3 target = random_point(random, shape);
    const int axis = random.below(3), other = (axis + 1) % 3;
    Ray ray;
    ray.direction = dvec3(0);
    ray.direction[axis] = random.chance(0.5) ? 1 : -1;
    if (random.chance(0.5)) ray.direction[other] = random.between(-1, 1);
    if (random.chance(0.3)) ray.direction[(axis + 2) % 3] = random.chance(0.5) ? kDenormal : -0.0;
    ray.origin = target - 4.0 * glm::normalize(ray.direction);
    Ray open = ray, shut = ray;
    open.t_min = 1e-30;
    open.t_max = 1e30;
    shut.t_max = 1e-30;
    rays.insert(rays.end(), {ray, open, shut});
  }
  const auto hits = trace_all(*scene, rays);
  for (std::size_t i = 0; i < rays.size(); i += 3) {
    const auto& a = hits[i];
    const auto& b = hits[i + 1];
    tally.trial();
    const auto text = [&] { return to_text(shape) + " " + to_text(rays[i]); };
    const bool agree = a.has_value() == b.has_value() && (!a || a->t == b->t) && !hits[i + 2];
    // Aimed at the surface or the inside: solids are met. The others may be parallel to the ray.
    const bool met = a.has_value() || !is_solid(kind);
    const bool finite = !a || (std::isfinite(a->t) && std::isfinite(glm::length(a->position)) &&
                               std::abs(glm::length(a->geometric_normal) - 1) < 1e-5);
    if (!agree || !met || !finite) tally.fail(text);
  }
}

}  // namespace

void add_degenerate_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"degenerate input",
       "no radius, area, height or volume, NaN, infinite, denormal and extreme numbers, camera on "
       "and inside things, coincident faces: a list, rendered at 16 x 16 pixels and 4 samples",
       {{"degenerate input, rejected with a message", "", kNoLimit, kNoLimit, 0},
        {"degenerate input, pictures with bad samples", "", kNoLimit, kNoLimit, 0},
        {"degenerate input, pixels of others that change", "", kNoLimit, kNoLimit, 0}},
       1,
       1,
       1,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random&, std::uint64_t, std::span<Tally> tallies) {
           for (const Case& c : all_cases()) judge(c, kernel, tallies);
         };
       }});
  tests.push_back(
      {"rays along axes",
       "directions with one or two components 0 or denormal, at all shapes; t to 1e30 and 1e-30",
       {{"rays along axes and with extreme ends", "", kNoLimit, kNoLimit, 0}},
       20'000,
       10'000'000,
       1024,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t i = 0; i < trials; i += 32) judge_rays(random, kernel, tallies[0]);
         };
       }});
}

}  // namespace lightbench::stress
