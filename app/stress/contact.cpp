// Surfaces that touch or nearly touch: no light passes between them, and the nearer one is seen.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/stress/oracle.h"
#include "app/stress/scenes.h"
#include "app/stress/suite.h"

namespace lightbench::stress {
namespace {

using glm::dvec3;
constexpr std::uint64_t kRaysPerScene = 1024;

/// A ball on a floor in some units and place: shadow rays from the floor, 10^U(-9,-.3) radii from
/// the point of contact, to points inside the ball.
void shadow_gap(Random& random, std::uint64_t trials, KernelKind kernel, Tally& tally) {
  for (std::uint64_t done = 0; done < trials; done += kRaysPerScene) {
    Scene scene = empty_scene();
    const double scale = random.decade(-4, 4);
    const dvec3 place = random.chance(0.5) ? 10 * scale * random.direction() : dvec3(0);
    const auto at = [&](const dvec3& p) { return scale * p + place; };
    add_object(scene, RectangleShape{at({-10, 0, 10}), {20 * scale, 0, 0}, {0, 0, -20 * scale}});
    add_object(scene, SphereShape{at({0, 1, 0}), scale, {0, 0, 0}});
    scene.camera.look_from = at({0, 5, 20});
    const auto compiled = compile(scene, kernel);
    std::vector<Ray> below;
    std::vector<dvec3> targets;
    for (std::uint64_t i = 0; i < kRaysPerScene; ++i) {
      const double away = random.decade(-9, -0.3), angle = random.between(0, 2 * std::numbers::pi);
      Ray ray;
      ray.origin = at({away * std::cos(angle), -1, away * std::sin(angle)});
      ray.direction = {0, 1, 0};
      ray.from.object = 1;  // the ball, which is as near there
      below.push_back(ray);
      targets.push_back(at(dvec3(0, 1, 0) + 0.999 * std::cbrt(random.unit()) * random.direction()));
    }
    const auto floor = trace_all(*compiled, below);
    std::vector<Ray> shadows;
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (!floor[i] || floor[i]->object != 0) {
        tally.trial();
        tally.fail([&] { return "the floor is not seen from below by " + to_text(below[i]); });
        continue;
      }
      shadows.push_back(spawn(*compiled, *floor[i], targets[i] - floor[i]->position));
    }
    std::vector<std::uint8_t> blocked(shadows.size());
    occluded(*compiled, shadows, blocked);
    for (std::size_t i = 0; i < shadows.size(); ++i) {
      tally.trial();
      if (blocked[i] != 0) continue;
      tally.fail([&] { return fmt::format("radius {:.17g}: {}", scale, to_text(shadows[i])); });
    }
  }
}

/// A ball within a shell that is wider by `gap`: from outside only the shell is seen, from the
/// middle only the ball.
void shell(Random& random, std::uint64_t trials, KernelKind kernel, double gap, Tally& tally) {
  for (std::uint64_t done = 0; done < trials; done += kRaysPerScene) {
    Scene scene = empty_scene();
    const bool ball_first = random.chance(0.5);
    add_object(scene, SphereShape{{0, 0, 0}, ball_first ? 1 : 1 + gap, {0, 0, 0}});
    add_object(scene, SphereShape{{0, 0, 0}, ball_first ? 1 + gap : 1, {0, 0, 0}});
    scene.camera.look_from = {0, 0, 3};
    const auto compiled = compile(scene, kernel);
    std::vector<Ray> rays(kRaysPerScene);
    for (Ray& ray : rays) {
      const dvec3 p = random.direction();
      if (random.chance(0.7)) {
        ray.origin = (1 + random.decade(-3, 0.5)) * random.direction();
        ray.direction = 0.999 * p - ray.origin;
      } else {
        ray.origin = random.between(0, 0.9) * random.direction();
        ray.direction = p;
      }
    }
    const auto hits = trace_all(*compiled, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const bool outside = glm::length(rays[i].origin) > 1;
      const int ball = ball_first ? 0 : 1, expected = outside ? 1 - ball : ball;
      tally.trial();
      if (hits[i] && hits[i]->object == expected) continue;
      tally.fail([&] {
        return fmt::format("the {} is first, {} from {}", ball_first ? "ball" : "shell",
                           to_text(rays[i]), outside ? "outside" : "inside");
      });
    }
  }
}

}  // namespace

void add_contact_tests(std::vector<Test>& tests) {
  tests.push_back({"contact",
                   "a ball of radius 10^U(-4,4) on a floor, shadow rays from 10^U(-9,-.3) radii "
                   "beside the contact to points in the ball",
                   {{"shadow gap below a resting ball", "", kNoLimit, kNoLimit, 0}},
                   100'000,
                   100'000'000,
                   4096,
                   [](KernelKind kernel) -> Chunk {
                     return
                         [kernel](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
                           shadow_gap(random, trials, kernel, tallies[0]);
                         };
                   }});
  for (const auto& [name, gap] : {std::pair{"4e-5", 4e-5}, {"1e-9", 1e-9}}) {
    tests.push_back(
        {std::string("shell ") + name + " wider",
         std::string("a ball in a shell ") + name +
             " of its radius wider, in either order; rays from outside and inside",
         {{std::string("ball in a shell ") + name + " wider", "", kNoLimit, kNoLimit, 0}},
         100'000,
         100'000'000,
         4096,
         [gap = gap](KernelKind kernel) -> Chunk {
           return [kernel, gap](Random& random, std::uint64_t trials, std::span<Tally> tallies) {
             shell(random, trials, kernel, gap, tallies[0]);
           };
         }});
  }
}

}  // namespace lightbench::stress
