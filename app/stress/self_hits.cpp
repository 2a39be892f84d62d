// Rays that leave a surface as the path tracer's do: they must not meet it again where they start,
// and start close to it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/shapes.h"
#include "app/stress/suite.h"
#include "core/scene/transform.h"

namespace lightbench::stress {
namespace {

constexpr std::uint64_t kRaysPerScene = 64;
/// Rays that leave a solid nearer to its edges than this (of its size) may miss the other side.
constexpr Number kBorder = 4e-3L;

/// One object in its scene, alone or far away from two others that hold render space at the origin.
struct Stage {
  Kind kind = Kind::Sphere;
  Shape shape;  ///< in object space
  Transform transform;
  double size = 1, offset = 0;
  bool alone = true;
  Matrix to_object{1};
  int object = 0;
  std::shared_ptr<const RenderScene> scene;
};

Stage random_stage(Random& random, KernelKind kernel) {
  Stage s;
  s.kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
  s.size = random.decade(-4, 6);
  const double offsets[] = {0, 1e5, 1e7};
  s.offset = offsets[random.below(3)];
  s.alone = s.offset == 0 || random.chance(0.5);
  s.transform.scale = glm::dvec3(s.size);
  s.transform.translation = (s.offset * s.size) * random.direction();
  if (random.chance(0.5)) {
    s.transform.axis = random.direction();
    s.transform.degrees = random.between(-180, 180);
    if (s.kind != Kind::Box || random.chance(0.5)) {
      const double low = random.decade(-3, 0), middle = random.decade(-3, 0);
      s.transform.scale *= glm::dvec3(low, 1, middle);
    }
  }
  Scene scene = empty_scene();
  if (s.kind == Kind::Mesh) {
    add_mesh(scene, cube_mesh(0.5), s.transform);
    s.shape = BoxShape{glm::dvec3(-0.5), glm::dvec3(0.5)};
  } else {
    s.shape = random_shape(random, s.kind);
    add_object(scene, s.shape, s.transform);
  }
  if (!s.alone) {
    for (int k = 0; k < 2; ++k) {
      add_object(scene, SphereShape{.center = glm::dvec3(0), .radius = s.size, .motion = {}});
    }
  }
  scene.camera.look_from = s.transform.translation;
  scene.camera.look_at = s.transform.translation + s.size * glm::dvec3(0, 0, -1);
  s.to_object = glm::inverse(Matrix(object_to_world(s.transform)));
  s.scene = compile(scene, kernel);
  return s;
}

/// Aimed at a point of the object from some sizes away.
Ray random_ray(Random& random, const Stage& s) {
  const glm::dmat4 to_world = object_to_world(s.transform);
  const glm::dvec3 at = s.kind == Kind::Mesh ? random.in_cube(0.5) : random_point(random, s.shape);
  Ray ray;
  ray.direction = random.direction();
  ray.origin = transform_point(to_world, at) - (4 * s.size) * ray.direction;
  return ray;
}

enum SelfHitLine { kSelfHit, kLost, kGapAlone, kGapFar, kGapVeryFar };

std::string describe(const Stage& s, const Ray& ray) {
  return fmt::format("{} {}, scale {}, {} degrees around {}, at {}{}: {} inside {}",
                     s.kind == Kind::Mesh ? "mesh" : "", to_text(s.shape),
                     to_text(s.transform.scale), s.transform.degrees, to_text(s.transform.axis),
                     to_text(s.transform.translation), s.alone ? "" : " beside others",
                     to_text(ray), ray.from.inside);
}

void judge_gap(const Stage& s, const Ray& ray, const Hit& hit, std::span<Tally> tallies) {
  const V start = V(ray.origin) + V(ray.origin_remainder);
  const auto gap = static_cast<double>(glm::length(start - exact_position(hit)) / Number(s.size));
  Tally& tally = tallies[s.alone ? kGapAlone : (s.offset < 1e6 ? kGapFar : kGapVeryFar)];
  tally.trial();
  tally.measure(gap, [&] { return describe(s, ray); });
}

/// How far off the kernel's numbers let a face lie, in object space. A solid scaled down by a
/// thousand along one axis is as much less certain there, in its own units: a chord within that of
/// its face may end anywhere on it.
Number face_error(const Stage& s) {
  Number squares = 0;
  for (int column = 0; column < 3; ++column) {
    const V v(s.to_object[column]);
    squares += glm::dot(v, v);
  }
  return Number(8 * rounding_of(*s.scene) * s.size) * std::sqrt(squares);
}

void judge(const Stage& s, const Ray& ray, const std::optional<Hit>& again,
           std::span<Tally> tallies) {
  const auto text = [&] { return describe(s, ray); };
  const bool met = again && again->object == s.object;
  tallies[kSelfHit].trial();
  if (!ray.from.inside || !is_solid(s.kind)) {
    // All shapes here are flat or convex, so whatever leaves them is gone.
    const bool same =
        s.kind != Kind::Mesh || !ray.from.inside || (met && again->triangle == ray.from.triangle);
    if (met && same) tallies[kSelfHit].fail(text);
    return;
  }
  const OracleRay local = into_object(exact_ray(*s.scene, ray), s.to_object);
  const Span span = solid_span(s.shape, local, -face_error(s));
  const Number length = glm::length(local.d);
  if (met && span.hit && Number(again->t) < span.far / 2 && span.far * length > kBorder) {
    tallies[kSelfHit].fail([&] {
      return fmt::format("{}, met at {} instead of {}", text(), again->t,
                         static_cast<double>(span.far));
    });
  }
  const Span inner = solid_span(s.shape, local, -kBorder);
  if (!inner.hit || inner.far < 0) return;
  tallies[kLost].trial();
  if (!met) tallies[kLost].fail(text);
}

}  // namespace

void add_self_hit_tests(std::vector<Test>& tests) {
  tests.push_back(
      {"rays that leave surfaces",
       "all shapes, size 10^U(-4,6), 0, 1e5 or 1e7 sizes from 0, alone or with two spheres at 0; "
       "half of them rotated and scaled unevenly by 10^U(-3,0); cos 10^U(-4,0), both sides",
       {{"self-hits", "", kNoLimit, kNoLimit, 0},
        {"solids left by rays that go inside", "", kNoLimit, kNoLimit, 0},
        {"origin's gap, alone at up to 1e7 sizes", "gap / size", 1e-9, 1e-6},
        {"origin's gap, 1e5 sizes from the rest", "gap / size", 1e-9, 1e-9},
        {"origin's gap, 1e7 sizes from the rest", "gap / size", 1e-7, 1e-7}},
       200'000,
       100'000'000,
       4096,
       [](KernelKind kernel) -> Chunk {
         return [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
           for (std::uint64_t done = 0; done < trials; done += kRaysPerScene) {
             const Stage s = random_stage(random, kernel);
             std::vector<Ray> rays(kRaysPerScene);
             for (Ray& ray : rays) ray = random_ray(random, s);
             const auto hits = trace_all(*s.scene, rays);
             std::vector<Ray> leaving;
             for (const std::optional<Hit>& hit : hits) {
               if (!hit || hit->object != s.object) continue;
               const double cosine = random.decade(-4, 0) * (random.chance(0.5) ? 1 : -1);
               const glm::dvec3& n = hit->geometric_normal;
               const glm::dvec3 d = cosine * n + std::sqrt(1 - cosine * cosine) * random.across(n);
               leaving.push_back(spawn(*s.scene, *hit, d));
               judge_gap(s, leaving.back(), *hit, tallies);
             }
             const auto again = trace_all(*s.scene, leaving);
             for (std::size_t i = 0; i < leaving.size(); ++i) {
               judge(s, leaving[i], again[i], tallies);
             }
           }
         };
       }});
}

}  // namespace lightbench::stress
