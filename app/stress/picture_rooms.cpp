// Closed rooms whose walls and contents all emit Le and reflect rho: after k segments of a path the
// radiance is Le (1 + rho + ... + rho^(k-1)) everywhere, whatever the shapes are.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/proof/build_scene.h"
#include "app/proof/same_world.h"
#include "app/stress/pictures.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;

KnownPicture draw_room(Random& random, Precision) {
  KnownPicture known;
  Scene& s = known.scene;
  s = dark_scene(16);
  const double albedos[] = {0.2, 0.5, 0.8, 0.95};
  const double albedo = albedos[random.below(4)];
  Material wall = lambertian(dvec3(albedo));
  wall.emissive = dvec3(0.75);
  wall.two_sided = true;
  const std::vector<PlacedShape> shapes = closed_shapes(s);
  const PlacedShape& room = shapes[static_cast<std::size_t>(random.below(9))];
  add(s, room.shape, wall, room.transform);
  // Contents about the middle, where every one of the rooms has space, touching each other.
  const bool furnished = random.chance(0.5);
  if (furnished) {
    add(s, BoxShape{{-0.2, -0.3, -0.2}, {0.2, -0.1, 0.2}}, wall);
    add(s, SphereShape{{0, 0, 0}, 0.1, {0, 0, 0}}, wall);
    add(s, CylinderShape{{0.15, -0.1, 0}, {0.15, 0.1, 0}, 0.05}, wall);
  }
  const dvec3 eye(0.05, 0.13, -0.18);
  look(s, eye, eye + random.direction(), 100);
  const int depth = random.chance(0.25) ? 1000 : 1 + random.below(11);
  s.render.max_depth = depth;
  if (random.chance(0.5)) s.render.roulette_depth = 1 + random.below(4);
  const double scale = random.decade(-4, 4);
  const double sizes = random.chance(0.5) ? random.decade(0, 5) : 0;
  s = in_other_units(s, scale, sizes * scale * random.direction());
  known.low = known.high = 0.75 * (1 - std::pow(albedo, depth)) / (1 - albedo);
  known.what = fmt::format(
      "room in a {}{}, albedo {}, {} segments, roulette from {}, size {:.3g}, "
      "{:.3g} sizes from 0",
      room.name, furnished ? " with contents" : "", albedo, depth, s.render.roulette_depth, scale,
      sizes);
  return known;
}

}  // namespace

void add_room_tests(std::vector<Test>& tests) {
  add_known_pictures(tests, "emissive rooms",
                     "walls and touching contents of the same glow, nine closed shapes, albedo .2 "
                     ".5 .8 .95, 1 to 11 segments or all, size 10^U(-4,4), up to 1e5 sizes from 0",
                     6, 800, draw_room);
}

}  // namespace lightbench::stress
