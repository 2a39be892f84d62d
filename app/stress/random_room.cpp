#include "app/stress/random_room.h"

#include <array>

#include "app/proof/build_scene.h"
#include "app/stress/shapes.h"

namespace lightbench::stress {
using namespace proof;
namespace {

using glm::dvec3;

dvec3 random_colour(Random& random) {
  const double r = random.between(0.2, 0.9), g = random.between(0.2, 0.9);
  return {r, g, random.between(0.2, 0.9)};
}

Material random_material(Random& random) {
  const dvec3 colour = random_colour(random);
  switch (random.below(6)) {
    case 0:
      return mirror(colour);
    case 1:
      return glass(random.between(1.2, 2));
    case 2:
      return fuzzy_metal(colour, random.between(0.3, 1));
    case 3:
      // Narrow lobes leave light sampling alone with rare bright samples, which no t-test likes.
      return rough_metal(colour, random.between(0.5, 1));
    default:
      return lambertian(colour);
  }
}

void add_random(Random& random, Scene& s, Kind kind, const Material& material,
                const Transform& transform) {
  if (kind == Kind::Mesh) {
    add(s, MeshShape{add_mesh(s, octahedron(0.7))}, material, transform);
  } else {
    add(s, random_shape(random, kind), material, transform);
  }
}

}  // namespace

Scene random_room(Random& random, int size) {
  Scene s = dark_scene(size);
  s.render.max_depth = 2 + random.below(6);
  s.render.roulette_depth = 1 + random.below(4);
  add(s, BoxShape{{-3, -3, -3}, {3, 3, 3}}, lambertian(dvec3(0.6)));
  // One object to each corner of a tetrahedron, lights above and beside: nothing touches.
  const std::array<dvec3, 4> places{dvec3(-1.6, -1.8, -1), dvec3(1.6, -1.8, -1),
                                    dvec3(-1.5, 1.4, -1.2), dvec3(1.5, -0.2, -2)};
  for (const dvec3& place : places) {
    Transform t = turned(random.direction(), random.between(0, 360), place);
    t.scale = dvec3(random.between(0.5, 0.9));
    const Kind kind = kKinds[random.below(static_cast<int>(std::size(kKinds)))];
    add_random(random, s, kind, random_material(random), t);
  }
  const Kind lights[] = {Kind::Sphere, Kind::Disc, Kind::Rectangle, Kind::Triangle};
  for (const dvec3& place : {dvec3(0.5, 2, 0), dvec3(-2, 0, 1)}) {
    Transform t = turned(random.direction(), random.between(0, 360), place);
    t.scale = dvec3(random.between(0.6, 0.9));
    add_random(random, s, lights[random.below(4)], light(3.0 * random_colour(random), true), t);
  }
  if (random.chance(0.3)) {
    add_medium(s, BoxShape{{-2.9, -2.9, -2.9}, {2.9, 2.9, 2.9}}, random.between(0.02, 0.1),
               random_colour(random));
  }
  if (random.chance(0.3)) {
    add(s, SphereShape{{0, -0.5, 0}, 0.4, {0.5, 0.3, 0}}, random_material(random));
  }
  look(s, {0.2, 0.1, 2.9}, {0, -0.2, 0}, 70);
  if (random.chance(0.3)) {
    s.camera.lens_radius = 0.05;
    s.camera.focus_distance = 3;
  }
  return s;
}

std::string describe_room(const Scene& scene) {
  std::string text = "room of " + std::to_string(scene.objects.size()) + " objects, depth " +
                     std::to_string(scene.render.max_depth);
  if (!scene.media.empty()) text += ", fog";
  if (scene.camera.lens_radius > 0) text += ", lens";
  return text;
}

}  // namespace lightbench::stress
